"""The worst case over the uncertain quantities of a net row."""
