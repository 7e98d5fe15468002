"""A site of one net row that is soon solved, as the sheets of a workbook."""

import copy

import openpyxl

# One net row; two densities, one friction angle, one inclination.
SHEETS = {
    "Nets": [
        [
            "id",
            "slope angle [deg]",
            "snow thickness [m]",
            "upslope length [m]",
            "ground law",
            "net height [m]",
            "net stiffness [kN/m]",
            "post spacing [m]",
            "foot anchor",
            "uphill anchor",
            "downhill anchor",
            "uphill guy",
            "downhill guy",
            "post",
            "guys on each side of the post",
            "splay of the guys [deg]",
            "slack [-]",
            "post tilt [deg]",
            "uphill anchor distance [m]",
            "downhill anchor distance [m]",
            "layers of the snow",
            "axes of the anchors",
            "panel system",
            "anchors of the guys",
            "row above",
            "ground of the anchors",
            "design life in years",
            "distance to the next edge [m]",
            "mesh strength [kN/m]",
        ],
        [
            *("R1", 38, 2.5, 6, "free", 2.5, 8000, 3),
            *("A1", "A1", "A1", "G1", "G1", "P1", 2, 29),
            *(0.02, 15, 2.5, 2.5, "uniform", "along the pull", "none"),
            *("shared", "none", "till", 40, 30, 980),
        ],
    ],
    "Ranges": [
        ["quantity", "low", "high"],
        ["density [kg/m3]", 270, 400],
        ["friction angle [deg]", 30, 30],
        ["net inclination [deg]", 30, 30],
    ],
    "Anchors": [
        [
            *("id", "tendon resistance [kN]", "pull-out resistance [kN]", "basis"),
            *("kind of anchor", "ground", "corrosion protection"),
            *("protected for years", "drilled length [m]"),
            *("least cover of the bond [m]", "least distance to an edge [m]"),
            "head resistance across [kN]",
        ],
        [
            *("A1", 2500, 1900, "tested", "rope anchor", "till", "cover", 80),
            *(6, 0.5, 2, 350),
        ],
    ],
    "Ropes": [
        ["id", "minimum breaking force [kN]", "protected for years"],
        ["G1", 1400, 50],
    ],
    "Links": [
        ["type", "link", "strength of the link [kN]", "chain"],
        ["A1", "eye", 2000, "complete"],
        ["G1", "eye", 2000, "complete"],
    ],
    "Posts": [
        [
            *("id", "section area [cm2]", "bearing resistance [kN]"),
            *("second moment of area [cm4]", "buckling length [m]"),
            *("yield strength [MPa]", "post width [mm]", "section modulus [cm3]"),
            "sliding resistance of the base [kN]",
        ],
        ["P1", 180, 2500, 25000, 2.6, 355, 300, 1600, 1000],
    ],
    "Ends": [["net row", "types of the support"], ["R1", "as inside"]],
    "Project": [["item", "value"], ["standard", "nf-p-95-304-style"]],
}


def write_sheets(path, sheets):
    """Workbook of sheets by name, each a list of lines."""
    workbook = openpyxl.Workbook()
    workbook.remove(workbook.active)
    for name, lines in sheets.items():
        sheet = workbook.create_sheet(name)
        for line in lines:
            sheet.append(line)
    workbook.save(path)
    workbook.close()
    return path


def write_site(path, edit=None):
    """Workbook of the tiny site; ``edit`` may change its sheets before."""
    sheets = copy.deepcopy(SHEETS)
    if edit:
        edit(sheets)
    return write_sheets(path, sheets)
