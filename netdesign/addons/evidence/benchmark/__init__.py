"""The program measured: run time against error, stability, cost of the envelope."""
