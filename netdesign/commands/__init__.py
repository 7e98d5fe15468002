"""Commands of the program that are not in ``cli.py``, and what they share."""
