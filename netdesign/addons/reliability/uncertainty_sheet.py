"""Sheet Uncertainty: the scatter of quantities, of one net row or of all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from netdesign.site.cells.findings import Finding
from netdesign.site.headings import Table
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.model import Site
from netdesign.site.readings import refuse
from netdesign.site.tables import read_rows
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainQuantity:
    """What is known of the scatter of one quantity, of one net row or of all.

    Attributes
    ----------
    row_id : str
        Empty for all net rows.
    name : str
        "snow_height", "model", "resistance", ...: a line of ``assumed.toml``.
    distribution : str
        "gumbel", "lognormal" or "normal"; empty for that which is usual.
    mean_ratio : float or None
        Mean over the value of the workbook [-].
    variation : float
        Coefficient of variation [-].
    period : float or None
        Return period of the snow height of the workbook [a].
    source : str
        Where it is from, as typed; of an assumed one the key of the text that says so.
    is_assumed : bool
        Of ``assumed.toml``, not typed.
    """

    row_id: str
    name: str
    variation: float
    source: str
    distribution: str = ""
    mean_ratio: float | None = None
    period: float | None = None
    is_assumed: bool = False

    @property
    def source_in_words(self) -> Message:
        """Where it is from."""
        if self.is_assumed:
            return say(f"source.{self.source}")
        return say("source.typed", text=self.source)


def read_uncertain(
    table: Table | None, places: Mapping[str, str], findings: list[Finding]
) -> tuple[UncertainQuantity, ...]:
    """Scatter of some quantities, each of one net row or of all.

    It serves the notional reliability alone; no check hangs on it.

    Parameters
    ----------
    table : Table or None
        Sheet Uncertainty, if there is one.
    places : mapping of str to str
        Cells of the ids of sheet Rows.
    findings : list of Finding
        Appended to: unknown rows, a quantity that comes twice.
    """
    found: dict[tuple[str, str], UncertainQuantity] = {}
    lines = read_rows(table, findings)
    if places:
        refuse_unknown_ids((one["row"] for one in lines), places, findings)
    for line in lines:
        if any(one.state == "faulty" for one in line.values()):
            continue
        word = line["variable"].word
        quantity = UncertainQuantity(
            row_id=line["row"].word,
            name="model" if word == "model factor" else word.replace(" ", "_"),
            distribution=line["distribution"].word.lower(),
            mean_ratio=line["mean_ratio"].given_si,
            variation=line["variation"].si,
            period=line["period"].given_si,
            source=line["source"].word,
        )
        key = (quantity.row_id, quantity.name)
        if key in found:
            rule = say("uncertainty.twice")
            refuse(line["variable"], rule, say("uncertainty.once"), findings)
        found[key] = quantity
    return tuple(found.values())


def find_uncertain(site: Site, row_id: str, name: str) -> UncertainQuantity | None:
    """What is known of the scatter of a quantity: of the row, else of all."""
    typed: tuple[UncertainQuantity, ...] = site.of_addons.get("Uncertainty", ())
    of_rows = {one.row_id: one for one in typed if one.name == name}
    return of_rows.get(row_id, of_rows.get(""))
