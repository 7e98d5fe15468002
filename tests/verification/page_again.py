"""Checks worked out again from a page alone, by a calculator of its own."""

import html
import math
import re
from dataclasses import dataclass, field

ENDS = (0, 1, 2)  # low end, value, high end
# Formulas that the annex states once for all checks.
OF_ALL = {"E_d": "γ_E · E_k", "R_d": "R_k / γ_R", "μ": "E_d / R_d"}
# A resistance has no interval: it takes what it follows from at its value.
WITHOUT_INTERVAL = ("R_k",)
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
_VALUE = re.compile(rf"({_NUMBER}|∞|-)(?: \(({_NUMBER})–({_NUMBER})\))?(°| .*)?$")
_LINE = re.compile(r"[✓✗?†] (.+?) ?: (.*)$", re.DOTALL)
_SYMBOL = re.compile(r"[^\W\d](?:_?\w)*")
_FUNCTIONS = {"max": max, "min": min, "sqrt": math.sqrt, "sin": None, "cos": None,
              "tan": None}  # fmt: skip


def list_numbers(text):
    return [float(one) for one in re.findall(_NUMBER, text)]


@dataclass
class Calculation:
    """Steps of one check: printed value, or formula with its result."""

    title: str
    printed: dict = field(default_factory=dict)  # symbol: (low, value, high) as printed
    formulas: dict = field(default_factory=dict)
    derived: str = ""  # where R_k comes from dimensions


def read_annex(page):
    """Calculations of the annex, in their order."""
    page = re.sub(r"<sub>(\w+)</sub>", r"_\1", page)
    start = page.index('id="annex-checks"')
    section = page[start : page.index("</section>", start)]
    for cell in re.findall(r'<th scope="row">(.*?)</th>', section, re.S):
        steps, *_ = clean(cell).split("\n")  # below it stand resistance and case
        name, told = _LINE.match(steps).groups()
        mode = re.sub(r", (second support|end of the row)$", "", name.strip())
        one = Calculation(f"{mode} (")
        read_steps(one, told)
        yield one


def read_ratios(page):
    """Title, E_d, R_d and μ of every check in the tables of the net rows."""
    for section in re.findall(r'<section id="row-\d+-checks".*?</section>', page, re.S):
        for line in re.findall(r"<tr>(.*?)</tr>", section, re.S):
            cells = re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", line, re.S)
            if len(cells) != 7 or 'scope="row"' not in line:
                continue
            member, mode, _, _, demand, resistance, _ = map(clean, cells)
            found = re.search(r'class="ratio">([^<]*)<', cells[6])
            used = found[1].rpartition("–")[2] if found else "-"  # at the worst ends
            yield f"{member}, {mode}", demand, resistance, used


def clean(text):
    text = html.unescape(re.sub("<[^>]*>", " ", text.replace("<br>", "\n")))
    return "\n".join(" ".join(line.split()) for line in text.split("\n"))


def read_steps(calculation, text):
    """Steps between semicolons that stand outside of brackets."""
    for step in split(text):
        symbol, _, rest = step.partition(" = ")
        if not rest:  # the case
            continue
        formula, _, result = rest.rpartition(" = ")
        read = _VALUE.match(result)
        if read is None:  # of a derivation, whose last number is the result
            continue
        value, low, high, _ = read.groups()
        number = {"∞": math.inf, "-": math.nan}.get(value) or float(value)
        ends = (number if low is None else float(low), number,
                number if high is None else float(high))  # fmt: skip
        calculation.printed[symbol] = ends
        if symbol == "R_k" and formula and not is_formula(formula, calculation):
            calculation.derived = formula
        elif formula:
            calculation.formulas[symbol] = formula


def is_formula(text, calculation):
    names = set(_SYMBOL.findall(text.replace("√", "sqrt")))
    return names <= set(calculation.printed) | set(_FUNCTIONS)


def split(text):
    """Parts of a text; a derivation of R_k has semicolons of its own."""
    parts, depth, start = [], 0, 0
    for place, sign in enumerate(text):
        depth += (sign == "(") - (sign == ")")
        begins = re.match(
            r"; (?:[^\W\d](?:_?\w)* = |[\d.]+ / |load case)", text[place:]
        )
        if sign == ";" and depth == 0 and begins:
            after = text[place:]
            if text[start:].startswith("R_k = ") and not after.startswith("; γ_R"):
                continue
            parts.append(text[start:place].strip())
            start = place + 1
    return [*parts, text[start:].strip()]


def evaluate(formula, values, end):
    """Value of a printed formula at one end of its operands' intervals."""

    def turn(function):
        return lambda angle: function(math.radians(angle))

    below = re.findall(r"/ ([^\W\d](?:_?\w)*)", formula)  # the more, the less it is
    names = {
        symbol: ends[2 - end if symbol in below else end]
        for symbol, ends in values.items()
    }
    known = {f"s{k}": value for k, value in enumerate(names.values())}
    places = {symbol: f"s{k}" for k, symbol in enumerate(names)}
    text = formula.replace("·", "*").replace("−", "-").replace(";", ",")
    text = text.replace("√", "sqrt")
    text = _SYMBOL.sub(lambda found: places.get(found[0], found[0]), text)
    functions = {"max": max, "min": min, "sqrt": math.sqrt}
    functions |= {name: turn(getattr(math, name)) for name in ("sin", "cos", "tan")}
    return eval(text, {"__builtins__": {}}, known | functions)


@dataclass
class Again:
    """What was compared, and what differs."""

    count: int = 0
    wrong: list = field(default_factory=list)

    def same(self, what, printed, value, near=2e-3):
        self.count += 1
        if not math.isclose(printed, value, rel_tol=near, abs_tol=1e-9):
            self.wrong.append((what, printed, value))


def work_out(checks):
    """Every result of every check, from the lines above it."""
    again = Again()
    for check in checks:
        _work_out_check(check.title, check, again)
    return again


def divide(ratios):
    """Every utilisation that the net rows print, from its two forces in print."""
    again = Again()
    for title, demand, resistance, used in ratios:
        again.count += not {demand, resistance, used} & {"-", "∞"}
        if not _divides(demand, used, resistance):
            again.wrong.append((title, demand, resistance, used))
    return again


def _divides(demand, used, resistance):
    """The ratio is that of the forces, each right to its last digit."""
    if "-" in (demand, used, resistance) or used == "∞":
        return True
    force, resists, ratio = map(_read_rounded, (demand, resistance, used.lstrip(">")))
    return ratio[1] >= force[0] / resists[1] and ratio[0] <= force[1] / resists[0]


def _read_rounded(text):
    """Least and largest number that is rounded to a printed one."""
    half = 0.5001 * 10.0 ** -len(text.partition(".")[2])
    return float(text) - half, float(text) + half


def _work_out_check(what, check, again):
    values = {symbol: ends for symbol, ends in check.printed.items()
              if symbol not in check.formulas and symbol not in OF_ALL}  # fmt: skip
    if check.derived:
        _work_out_derived(what, check, again)
    for symbol, formula in (check.formulas | OF_ALL).items():
        printed = check.printed.get(symbol)
        if printed is None or not all(map(math.isfinite, printed)):
            continue
        if symbol in OF_ALL and not {"R_k", "γ_R"} <= set(values) and symbol != "E_d":
            continue
        ends = [evaluate(formula, values, end) for end in ENDS]
        if symbol in WITHOUT_INTERVAL:
            ends = [ends[1]] * 3
        # steps between have no interval in print: it follows all the same
        values[symbol] = tuple(ends)
        again.same(f"{what}: {symbol}", printed[1], ends[1])
        if symbol in OF_ALL and printed[0] != printed[2]:
            again.same(f"{what}: {symbol} low", printed[0], ends[0])
            again.same(f"{what}: {symbol} high", printed[2], ends[2])


def _work_out_derived(what, check, again):
    told, printed = check.derived, check.printed["R_k"][1]
    rules = {
        "tendon": work_out_bar,
        "pull-out": work_out_pull_out,
        "rope": work_out_rope,
        "bearing": work_out_bearing,
        "compression": work_out_buckling,
        "connection": work_out_chain,
    }
    mode = re.search(r", ([a-z -]+) \(", check.title)[1]
    rule = rules.get(mode)
    if rule is not None:
        again.same(f"{what}: R_k of dimensions", printed, rule(told), 2e-3)


def work_out_bar(told):
    built, _, corroded = told.partition("; ")
    if "π" not in built:  # a resistance that is given
        corroded = built
        return leave_steel(corroded) * list_numbers(corroded)[0]
    *diameters, strength = list_numbers(built.replace("π/4", "π"))
    loss = find_loss(corroded)
    outer, inner = diameters[0] - 2.0 * loss, sum(diameters[1:])
    return math.pi / 4 * (outer**2 - inner**2) * strength / 1e3


def find_loss(told):
    """Loss of each face [mm]; 0 of steel that loses none."""
    found = re.search(r": ([\d.]+) mm", told)
    return float(found[1]) if found else 0.0


def leave_steel(told):
    return list_numbers(told)[1]


def work_out_chain(told):
    """Number, strength, the factors of a working load limit, that of a direction."""
    found = re.search(r": (\d+) · ([\d.]+) kN", told)
    strength = int(found[1]) * float(found[2])
    limit = re.search(r"limit · ([\d.]+) · ([\d.]+)", told)
    beside = re.search(r"; · ([\d.]+) ", told)
    for factor in (*(limit.groups() if limit else ()), beside[1] if beside else 1):
        strength *= float(factor)
    return strength


def work_out_pull_out(told):
    diameter, length, stress = list_numbers(told)[:3]
    return math.pi * diameter / 1e3 * length * stress


def work_out_rope(told):
    if " kN · " in told:
        force, loss = list_numbers(told)[:2]
        return force * loss
    factor, diameter, grade, loss = list_numbers(told)[:4]
    return factor * diameter**2 * grade * loss / 1e3


def work_out_bearing(told):
    length, width, stress, factor = list_numbers(told)[:4]
    return length * width * stress * factor


def work_out_buckling(told):
    _, area, strength = list_numbers(told)[:3]
    modulus, second, length = map(
        float,
        re.search(r"π² · ([\d.]+) MPa · ([\d.]+) cm⁴ / \(([\d.]+) m\)²", told).groups(),
    )
    alpha = float(re.search(r"α = ([\d.]+)", told).group(1))
    critical = math.pi**2 * modulus * 1e3 * second * 1e-8 / length**2  # kN
    slender = math.sqrt(area * strength / 10 / critical)
    phi = 0.5 * (1 + alpha * (slender - 0.2) + slender**2)
    root = math.sqrt(max(phi**2 - slender**2, 0.0))
    reduction = min(1.0, 1 / (phi + root)) if slender > 0.2 else 1.0
    return reduction * area * strength / 10
