"""Compiled core: kernels of the steady state in C, where a library of them was built.

Whatever is here is a kernel that the program has in NumPy, too, and the NumPy text is
the truth: the core is only faster. Theory: core/THEORY.md.
"""
