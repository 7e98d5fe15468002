"""The Swiss guideline's snow load as an independent check of the coupled solve."""
