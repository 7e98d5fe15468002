"""Widths of snow that the supports at a row's end carry, by the lever rule."""


def spread_end_effect(ratio, length, spacing):
    """Extra widths of the last support, the second and the third [m].

    A strip at z of the end length l_R carries f_R more; between two supports a strip
    goes to both by the lever rule (hat functions, integrated).
    """
    over = length / spacing
    if over <= 1.0:
        shares = (over - over**2 / 2.0, over**2 / 2.0, 0.0)
    else:
        more = over - 1.0
        shares = (0.5, 0.5 + more - more**2 / 2.0, more**2 / 2.0)
    return tuple(ratio * spacing * share for share in shares)
