"""Evidence: verification, benchmark, the source paper's study."""
