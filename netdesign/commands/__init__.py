"""Commands in modules of their own, registered by ``cli.py``."""
