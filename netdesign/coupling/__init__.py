"""Snow and net together: one scene, one solution."""
