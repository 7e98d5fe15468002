"""Units of quantities: what a product of two is, and which may be added."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache


@dataclass(frozen=True, slots=True)
class Dimension:
    """Powers of the base units: ``(("kN", 1), ("m", -2))``, in their order."""

    powers: tuple[tuple[str, int], ...] = ()

    def times(self, other: Dimension, power: int) -> Dimension:
        """Dimension of the product with a power of another one."""
        sums = dict(self.powers)
        for base, count in other.powers:
            sums[base] = sums.get(base, 0) + power * count
        return Dimension(tuple(sorted((b, n) for b, n in sums.items() if n)))

    def root(self) -> Dimension | None:
        """Dimension of the square root; None where it has none."""
        if any(count % 2 for _, count in self.powers):
            return None
        return Dimension(tuple((base, count // 2) for base, count in self.powers))


PURE = Dimension()
_POWERS = tuple("123456789")


@lru_cache
def find_dimension(unit: str) -> Dimension:
    """Dimension of a unit such as "kN", "kN/m2", "deg"; "-" is a pure number."""
    above, _, below = unit.partition("/")
    found = PURE
    for part, sign in ((above, 1), (below, -1)):
        base = part[:-1] if part[-1:] in _POWERS else part
        if base not in ("", "-"):
            power = int(part[len(base) :] or 1)
            found = found.times(Dimension(((base, 1),)), sign * power)
    return found


def name_dimension(dimension: Dimension) -> str:
    """Unit in words: ``kN m2``."""
    return " ".join(f"{b}{'' if n == 1 else n}" for b, n in dimension.powers) or "-"
