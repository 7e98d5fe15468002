"""Commands that would make ``cli.py`` too long; registered there."""
