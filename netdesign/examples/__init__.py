"""Three programs to start from: ``python -m netdesign.examples.one_net``."""
