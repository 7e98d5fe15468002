"""A site from Python: how far apart may the posts of a row stand?

The picture shows the largest utilisation of net row R1 of the built-in example, alone,
for four spacings of its posts. Below the broken line all checks pass. The workbook
itself stays as it is: each study reads another text in one of its cells.

Run ``python -m netdesign.examples.own_site``. It writes ``own_site.png``, or the file
that you name.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from netdesign import (
    CheckRun,
    SolverSettings,
    check_site,
    load_standard,
    read_site,
    write_site_workbook,
)

SPACINGS = (4.0, 5.0, 6.0, 7.0)  # [m]
SPACING_CELL = "Nets!L2"
RUN = CheckRun(settings=SolverSettings(accuracy=0.01))


def find_utilisation(workbook: Path, spacing: float) -> tuple[float, str]:
    """Largest utilisation of row R1 at a spacing, and the verdict of the row."""
    site = read_site(workbook, instead={SPACING_CELL: str(spacing)})
    alone = replace(site, rows=site.rows[:1])
    (study,) = check_site(alone, [load_standard("nf-p-95-304-style")], RUN)
    checks = study.rows[0].checks
    return max(one.utilisation or 0.0 for one in checks), study.verdict.value


def draw(utilisations: list[float], path: str) -> None:
    """Draw the utilisation against the spacing."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(SPACINGS, utilisations, "ko-")
    axes.axhline(1.0, color="black", linestyle="--")
    axes.set(
        xlabel="spacing of the posts [m]", ylabel="largest utilisation", ylim=(0, None)
    )
    figure.savefig(path)


def main() -> None:
    """Check the row at each spacing, print the verdicts and draw the utilisations."""
    path = sys.argv[1] if sys.argv[1:] else "own_site.png"
    utilisations = []
    with TemporaryDirectory() as folder:
        workbook = Path(folder) / "site.xlsx"
        write_site_workbook(workbook, example=True)
        for spacing in SPACINGS:
            utilisation, verdict = find_utilisation(workbook, spacing)
            print(f"{spacing:.1f} m  {utilisation:.3f}  {verdict}")
            utilisations.append(utilisation)
    draw(utilisations, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
