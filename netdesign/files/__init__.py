"""Scenes, solutions and envelopes as files."""
