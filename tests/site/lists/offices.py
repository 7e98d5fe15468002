"""Five lists in the style of offices, and what each heading of them means.

Made for the tests: German, French and English, xlsx and csv, with title blocks, units
in headings and below them, groups, columns that no check needs, remarks and sums. A
meaning is a column of the input workbook (`rows.slope_angle`), with what it measures
where that is a choice; `ignore`; or `ask`, where the heading alone cannot say it.
"""

import csv
from dataclasses import dataclass

import openpyxl


@dataclass(frozen=True)
class OfficeSheet:
    """A sheet: title lines, headings with their meanings, a row of units, lines."""

    name: str
    titles: tuple
    headings: dict
    lines: tuple
    units: tuple = ()
    below: tuple = ()


@dataclass(frozen=True)
class OfficeList:
    """A list of an office, its language and its file."""

    file: str
    language: str
    sheets: tuple
    delimiter: str = ";"

    def write(self, folder):
        """Write it; its place."""
        path = folder / self.file
        if path.suffix == ".csv":
            (sheet,) = self.sheets
            with path.open("w", encoding="utf-8", newline="") as file:
                csv.writer(file, delimiter=self.delimiter).writerows(_list_rows(sheet))
            return path
        book = openpyxl.Workbook()
        book.remove(book.active)
        for sheet in self.sheets:
            made = book.create_sheet(sheet.name)
            for line in _list_rows(sheet):
                made.append(line)
        book.save(path)
        book.close()
        return path


def _list_rows(sheet):
    """Lines of a sheet from its titles to what stands below."""
    rows = [*sheet.titles, tuple(sheet.headings)]
    rows += [sheet.units] if sheet.units else []
    return [list(one) for one in (*rows, *sheet.lines, *sheet.below)]


# An engineering office in Tyrol: everything in one workbook, types on their own sheet.
TYROL = OfficeList(
    file="Verbauung Gampen.xlsx",
    language="de",
    sheets=(
        OfficeSheet(
            name="Werke",
            titles=(("Lawinenverbauung Gampen", "Stand März"), ()),
            headings={
                "Pos.": "ignore",
                "Werk": "rows.id",
                "Seehöhe [m]": "rows.altitude",
                "Exp.": "ignore",
                "Hangneigung [°]": "rows.slope_angle",
                "max. Schneehöhe lotrecht [cm]": "rows.snow.vertical",
                "Gleitfaktor N [-]": "rows.glide_factor",
                "Hangabstand zur Reihe darüber [m]": "rows.upslope_length",
                "Werktyp": "rows.net_type",
                "wirksame Höhe Dk [m]": "net_types.net_height",
                "Stützenabstand [m]": "rows.post_spacing",
                "Anzahl Stützen": "rows.post_count",
                "Anker Netzfuß": "rows.foot_anchor",
                "Anker bergseits": "rows.uphill_anchor",
                "Anker talseits": "rows.downhill_anchor",
                "Untergrund": "rows.ground",
                "Anmerkung": "ignore",
            },
            lines=(
                (
                    1,
                    "G1",
                    1980,
                    "NO",
                    34,
                    310,
                    1.6,
                    19,
                    "T30",
                    3.0,
                    3.5,
                    10,
                    "IBO R38",
                    "IBO R32",
                    "IBO R32",
                    "Moräne",
                    None,
                ),
                (
                    2,
                    "G2",
                    1992,
                    "NO",
                    35,
                    310,
                    1.6,
                    20,
                    "T30",
                    3.0,
                    3.5,
                    12,
                    "IBO R38",
                    "IBO R32",
                    "IBO R32",
                    "Moräne",
                    "Rinne",
                ),
                (
                    3,
                    "G3",
                    2005,
                    "N",
                    36,
                    335,
                    1.8,
                    21,
                    "T30",
                    3.0,
                    3.5,
                    9,
                    "IBO R38",
                    "IBO R32",
                    "IBO R32",
                    "Moräne",
                    None,
                ),
                (
                    4,
                    "G4",
                    2018,
                    "N",
                    38,
                    335,
                    1.8,
                    22,
                    "T30",
                    3.0,
                    3.5,
                    9,
                    "IBO R38",
                    "IBO R32",
                    "IBO R32",
                    "Moräne",
                    None,
                ),
                (
                    5,
                    "H1",
                    2030,
                    "N",
                    37,
                    380,
                    2.0,
                    23,
                    "T35",
                    3.5,
                    3.5,
                    11,
                    "IBO R51",
                    "IBO R38",
                    "IBO R32",
                    "Fels",
                    None,
                ),
                (
                    6,
                    "H2",
                    2044,
                    "NW",
                    39,
                    380,
                    2.0,
                    24,
                    "T35",
                    3.5,
                    3.5,
                    11,
                    "IBO R51",
                    "IBO R38",
                    "IBO R32",
                    "Fels",
                    None,
                ),
                (
                    7,
                    "H3",
                    2056,
                    "NW",
                    41,
                    410,
                    2.2,
                    24,
                    "T40",
                    4.0,
                    3.0,
                    8,
                    "IBO R51",
                    "IBO R38",
                    "IBO R32",
                    "Fels",
                    None,
                ),
                (
                    8,
                    "H4",
                    2070,
                    "NW",
                    42,
                    410,
                    2.2,
                    25,
                    "T40",
                    4.0,
                    3.0,
                    8,
                    "IBO R51",
                    "IBO R38",
                    "IBO R32",
                    "Fels",
                    None,
                ),
            ),
        ),
        OfficeSheet(
            name="Ankertypen",
            titles=(),
            headings={
                "Typ": "anchor_types.id",
                "Art": "anchor_types.kind",
                "Bruchlast [kN]": "ask",
                "Streckgrenzlast [kN]": "anchor_types.tendon",
                "Untergrund": "anchor_types.ground",
                "Ausziehkraft kleinster Versuch [kN]": "anchor_types.pull_out",
                "Anzahl Versuche": "anchor_types.test_count",
                "Bohrkrone Ø [mm]": "anchor_types.drill_diameter",
                "Ankerlänge [m]": "anchor_types.drilled_length",
            },
            lines=(
                ("IBO R32", "Mikropfahl", 280, 230, "Moräne", 240, 3, 76, 5),
                ("IBO R32", "Mikropfahl", 280, 230, "Fels", 260, 3, 76, 4),
                ("IBO R38", "Mikropfahl", 500, 400, "Moräne", 390, 4, 90, 7),
                ("IBO R38", "Mikropfahl", 500, 400, "Fels", 430, 3, 90, 5),
                ("IBO R51", "Mikropfahl", 800, 630, "Fels", 640, 3, 115, 6),
            ),
        ),
    ),
)
# A Swiss office: one sheet as csv, semicolons and decimal commas, D_K without types.
VALAIS = OfficeList(
    file="liste_filets.csv",
    language="fr",
    sheets=(
        OfficeSheet(
            name="liste_filets",
            titles=(("Paravalanches Tsarmine",),),
            headings={
                "Filet": "rows.id",
                "Alt. [m]": "rows.altitude",
                "Pente [°]": "rows.slope_angle",
                "Hauteur de neige extrême verticale [m]": "rows.snow.vertical",
                "Facteur N": "rows.glide_factor",
                "Dk [m]": "net_types.net_height",
                "Écart poteaux [m]": "rows.post_spacing",
                "Nb poteaux": "rows.post_count",
                "Distance à la ligne amont [m]": "rows.upslope_length",
                "Ancrage pied du filet": "rows.foot_anchor",
                "Ancrage amont": "rows.uphill_anchor",
                "Ancrage aval": "rows.downhill_anchor",
                "Ancrage latéral": "rows.end_anchor",
                "Terrain": "rows.ground",
                "Observations": "ignore",
            },
            lines=tuple(
                (
                    f"F{one}",
                    str(2210 + 13 * one),
                    str(31 + one),
                    snow,
                    glide,
                    height,
                    "3,5",
                    "10",
                    "18",
                    "GEWI 32",
                    "GEWI 28",
                    "GEWI 28",
                    "GEWI 32",
                    "moraine",
                    "",
                )
                for one, (snow, glide, height) in enumerate(
                    [("3,1", "1,6", "3,0")] * 3
                    + [("3,8", "1,8", "3,5")] * 3
                    + [("4,2", "2,0", "4,0")] * 3,
                    1,
                )
            ),
        ),
    ),
)
# A French office: units below the headings, groups above, a line of totals.
SAVOIE = OfficeList(
    file="Récapitulatif ouvrages.xlsx",
    language="fr",
    sheets=(
        OfficeSheet(
            name="Ouvrages",
            titles=(
                ("Commune de Bessans", "Couloir du Vallon"),
                (
                    None,
                    "Site",
                    None,
                    None,
                    None,
                    "Ouvrage",
                    None,
                    None,
                    None,
                    "Ancrages",
                ),
            ),
            headings={
                "Rang": "rows.id",
                "Altitude": "rows.altitude",
                "Inclinaison du versant": "rows.slope_angle",
                "Épaisseur de neige normale": "rows.snow.normal",
                "Coefficient de glissement": "rows.glide_factor",
                "Hauteur utile Dk": "net_types.net_height",
                "Entraxe": "rows.post_spacing",
                "Nombre de poteaux": "rows.post_count",
                "Longueur de pente amont": "rows.upslope_length",
                "Ancrage du filet": "rows.foot_anchor",
                "Ancrage hauban amont": "rows.uphill_anchor",
                "Ancrage hauban aval": "rows.downhill_anchor",
                "Charge admissible": "ask",
            },
            units=(
                None,
                "m",
                "°",
                "m",
                "-",
                "m",
                "m",
                None,
                "m",
                None,
                None,
                None,
                "kN",
            ),
            lines=tuple(
                (
                    f"L{one}",
                    2300 + 15 * one,
                    33 + one,
                    2.6 + 0.1 * (one // 3),
                    1.8,
                    3.0 if one < 5 else 3.5,
                    3.5,
                    8 + one,
                    17 + one,
                    "GEWI 32",
                    "GEWI 28",
                    "câble 18",
                    250,
                )
                for one in range(1, 9)
            ),
            below=(("Total", None, None, None, None, None, None, 100),),
        ),
        OfficeSheet(
            name="Ancrages",
            titles=(),
            headings={
                "Type": "anchor_types.id",
                "Nature": "anchor_types.kind",
                "Résistance caractéristique acier (kN)": "anchor_types.tendon",
                "Diamètre barre (mm)": "anchor_types.bar_diameter",
                "Terrain": "anchor_types.ground",
                "Arrachement caractéristique (kN)": "anchor_types.pull_out",
                "Longueur scellée (m)": "anchor_types.bond_length",
                "Diamètre de forage (mm)": "anchor_types.drill_diameter",
                "Inclinaison sous l'horizontale (°)": "anchor_types.dip",
            },
            lines=(
                ("GEWI 28", "barre", 308, 28, "moraine", 300, 4, 90, 20),
                ("GEWI 32", "barre", 402, 32, "moraine", 420, 5, 105, 20),
                ("câble 18", "câble", 310, None, "moraine", 210, 4, 90, 20),
            ),
        ),
    ),
)
# A consultant who writes English: csv with commas and points, headings with symbols.
CONSULTANT = OfficeList(
    file="net_schedule.csv",
    language="en",
    delimiter=",",
    sheets=(
        OfficeSheet(
            name="net_schedule",
            titles=(),
            headings={
                "Row ID": "rows.id",
                "Elevation (m)": "rows.altitude",
                "Slope (deg)": "rows.slope_angle",
                "Design snow height, vertical (m)": "rows.snow.vertical",
                "Glide factor N": "rows.glide_factor",
                "Net height Dk (m)": "net_types.net_height",
                "Post spacing (m)": "rows.post_spacing",
                "No. of posts": "rows.post_count",
                "Upslope length (m)": "rows.upslope_length",
                "Gap to adjacent row (m)": "rows.gap",
                "Net anchor": "rows.foot_anchor",
                "Uphill anchor": "rows.uphill_anchor",
                "Downhill anchor": "rows.downhill_anchor",
                "Lateral anchor": "rows.end_anchor",
                "Allowable anchor load (kN)": "ask",
                "Comments": "ignore",
            },
            lines=tuple(
                (
                    f"R{one}",
                    1850 + 11 * one,
                    35 + one,
                    3.2,
                    1.8,
                    3.0,
                    3.5,
                    9,
                    20,
                    2,
                    "R32N",
                    "R32N",
                    "R25N",
                    "R32N",
                    150,
                    "",
                )
                for one in range(1, 9)
            ),
        ),
    ),
)
# A Swiss-German office: net types with their numbers on a sheet of their own.
GRISONS = OfficeList(
    file="Netzliste Val Mela.xlsx",
    language="de",
    sheets=(
        OfficeSheet(
            name="Reihenliste",
            titles=(("Projekt", "Val Mela", "Rev. b"), (), ()),
            headings={
                "Reihe": "rows.id",
                "Koten [m ü. M.]": "rows.altitude",
                "Neigung ψ [°]": "rows.slope_angle",
                "Hext [m]": "rows.snow.vertical",
                "N [-]": "rows.glide_factor",
                "L [m]": "rows.upslope_length",
                "Netz": "rows.net_type",
                "a [m]": "rows.post_spacing",
                "Stützen [Stk]": "rows.post_count",
                "Netzanker": "rows.foot_anchor",
                "Berganker": "rows.uphill_anchor",
                "Talanker": "rows.downhill_anchor",
                "Randanker": "rows.end_anchor",
                "Baugrund": "rows.ground",
                "Datum Begehung": "ignore",
            },
            lines=tuple(
                (
                    f"{letter}{one}",
                    2240 + 17 * one,
                    32 + 2 * one,
                    snow,
                    1.8,
                    18,
                    net,
                    3.5,
                    9 + one,
                    "SWI 32",
                    "SWI 28",
                    "SWI 28",
                    "SWI 32",
                    "Moräne",
                    "12.07.",
                )
                for letter, snow, net in (("A", 3.4, "N 3.0"), ("B", 3.9, "N 3.5"))
                for one in range(1, 5)
            ),
        ),
        OfficeSheet(
            name="Netztypen",
            titles=(),
            headings={
                "Netz": "net_types.id",
                "Dk [m]": "net_types.net_height",
                "Typenprüfung": "net_types.approval",
                "zugelassen bis N": "net_types.glide_most",
                "Durchhang [%]": "net_types.slack.sag",
                "Neigung der Stütze [°]": "net_types.post_tilt",
            },
            lines=(
                ("N 3.0", 3.0, "SLF 11-2", 2.5, 14, 15),
                ("N 3.5", 3.5, "SLF 11-2", 2.5, 14, 15),
            ),
        ),
    ),
)
OFFICES = (TYROL, VALAIS, SAVOIE, CONSULTANT, GRISONS)
