"""Agreement of a stored study with itself, its site and its profile; unsolved."""

from netdesign.study.audit.study_audit import audit_study

__all__ = ["audit_study"]
