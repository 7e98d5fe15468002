"""Texts that a user reads: a key with arguments, rendered in a language at the edge."""
