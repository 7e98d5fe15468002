"""Agreement of a stored study with itself, its site and its profile; unsolved."""

from netdesign.study.rejudge.study import rejudge

__all__ = ["rejudge"]
