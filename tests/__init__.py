"""Tests of netdesign; a package, so that none of another name comes before it."""
