"""A site from Python: the utilisation of a row against the spacing of its posts.

The picture shows the largest utilisation of the anchors of row A1 of the built-in
example, for four spacings of its posts. They pass below the broken line. At 4.50 m the
stiffness of the net decides, which nobody gave: they are not proven.

The workbook stays as it is. Each study is a what-if with another spacing.

Run ``python -m netdesign.examples.own_site``. It writes ``own_site.png``, or the file
that you name.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from netdesign import check, write_site_workbook

SPACINGS = (3.0, 4.0, 4.5, 6.0)  # [m]


def find_utilisation(workbook: Path, spacing: float) -> tuple[float, str]:
    """Largest utilisation of the anchors of row A1 at a spacing, and their verdict."""
    study = check(workbook, rows=["A1"], change={"A1": {"post_spacing": spacing}})
    anchors, *_ = study.rows[0].scopes.values()
    return anchors.utilisation or 0.0, anchors.verdict.value


def draw(found: list[tuple[float, str]], path: str) -> None:
    """Draw the utilisation against the spacing, with the verdicts."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(SPACINGS, [utilisation for utilisation, _ in found], "ko-")
    for spacing, (utilisation, verdict) in zip(SPACINGS, found, strict=True):
        name = verdict.replace("_", " ").upper()
        axes.text(spacing + 0.1, utilisation - 0.03, name, va="top")
    axes.axhline(1.0, color="black", linestyle="--")
    axes.set(xlabel="spacing of the posts [m]", ylabel="largest utilisation")
    axes.set(xlim=(2.5, 7.0), ylim=(0.0, 1.6))
    figure.savefig(path)


def main() -> None:
    """Check the row at each spacing, print the verdicts and draw the utilisations."""
    path = sys.argv[1] if sys.argv[1:] else "own_site.png"
    found = []
    with TemporaryDirectory() as folder:
        workbook = Path(folder) / "site.xlsx"
        write_site_workbook(workbook, example=True)
        for spacing in SPACINGS:
            utilisation, verdict = find_utilisation(workbook, spacing)
            print(f"{spacing:.2f} m  {utilisation:.3f}  {verdict}")
            found.append((utilisation, verdict))
    draw(found, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
