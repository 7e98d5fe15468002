"""Checks the anchors of snow nets by a coupled snowpack-net calculation."""

from importlib.metadata import version

__version__ = version("netdesign")
