"""A limit profile: the anchor that each profile asks for, under the same snow.

The picture shows the pull-out resistance that an anchor needs in tests, so that it
holds a characteristic force of 200 kN. It is the force, times the factor on actions,
times the factor on resistances. The broken line is the force itself.

The profiles differ, and most of their factors are not confirmed: read the number of
them that is printed. Run ``python -m netdesign.examples.limit_profile``. It writes
``limit_profile.png``, or the file that you name.
"""

from __future__ import annotations

import sys

from netdesign import Standard, list_standards, load_standard

FORCE = 200.0  # characteristic [kN]


def find_needed(profile: Standard) -> float:
    """Characteristic pull-out resistance that the force needs [kN]."""
    action = profile.find("action.snow")
    resistance = profile.find_resistance_factor("pull_out", "tested")
    if action is None or resistance is None:
        raise SystemExit(f"{profile.id} lacks a factor")
    return FORCE * action.value * resistance.value


def draw(needed: dict[str, float], path: str) -> None:
    """Draw one bar a profile."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 2.6), layout="constrained")
    axes = figure.subplots()
    names, forces = list(needed), list(needed.values())
    bars = axes.barh(names, forces, color="0.8", edgecolor="black")
    axes.bar_label(bars, fmt="%.0f", padding=3)
    axes.axvline(FORCE, color="black", linestyle="--")
    axes.set(xlabel="pull-out resistance needed [kN]", xlim=(0.0, 1.15 * max(forces)))
    figure.savefig(path)


def main() -> None:
    """Read each profile, print what it asks for and draw it."""
    path = sys.argv[1] if sys.argv[1:] else "limit_profile.png"
    needed = {}
    for name in list_standards():
        profile = load_standard(name)
        needed[name] = find_needed(profile)
        open_values = f"{len(profile.assumed)} of {len(profile.listed)} values assumed"
        print(f"{name:22} {needed[name]:.1f} kN, {open_values}")
    draw(needed, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
