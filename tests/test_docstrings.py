"""Every public name says what it is; numbers of the physics say their unit."""

import ast
import doctest
import inspect
import re
import tomllib
from collections.abc import Iterator

from tests.each import each
from tests.sources import PACKAGE, parse_package

ROOT = PACKAGE.parent
PHYSICS = (
    *("numerics", "snow", "cable", "structure", "coupling", "checks"),
    *("resistance", "guideline", "panel", "snowpack", "winter"),
)

# A number says its unit in brackets, its shape if it is an array, or that it has
# the unit of, or is taken relative to, something that it names.
STATED = re.compile(r"\[[^\]]+\]|\bshape\b|\bunit\b|\bover\b|dimensionless", re.I)
# Entries about a quantity of any kind.
ANY_QUANTITY = {("judge", "low, high")}

Documented = ast.Module | ast.ClassDef | ast.FunctionDef


def list_physics() -> list[str]:
    return [name for name in parse_package() if name.startswith(PHYSICS)]


def list_numerical() -> list[str]:
    return [name for name in parse_package() if name.startswith(NUMERICAL)]


def public(node: Documented, name: str = "") -> Iterator[tuple[str, Documented]]:
    """Module, its public functions and classes, and their public methods."""
    yield name or "module", node
    for child in node.body if not isinstance(node, ast.FunctionDef) else ():
        is_named = isinstance(child, ast.ClassDef | ast.FunctionDef)
        if is_named and not child.name.startswith("_"):
            yield from public(child, f"{name}.{child.name}".lstrip("."))


def sections(docstring: str) -> dict[str, list[str]]:
    """Lines below each underlined heading."""
    found: dict[str, list[str]] = {}
    lines = inspect.cleandoc(docstring).splitlines()
    heading = ""
    for line, following in zip(lines, [*lines, ""][1:], strict=True):
        if line and re.fullmatch("-{3,}", following):
            heading = line
            found[heading] = []
        elif heading and not re.fullmatch("-{3,}", line):
            found[heading].append(line)
    return found


def entries(lines: list[str]) -> list[tuple[str, str, str]]:
    """Name, kind and description of each entry of a section."""
    found: list[list[str]] = []
    for line in lines:
        if line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            found.append([name, kind, ""])
        elif found:
            found[-1][2] += f" {line.strip()}"
    return [(name, kind, text) for name, kind, text in found]


def unstated(function: str, docstring: str) -> list[str]:
    """Numbers among the parameters that say neither unit nor shape."""
    return [
        f"{function}({name})"
        for name, kind, text in entries(sections(docstring).get("Parameters", []))
        if re.search(r"\b(float|ndarray)\b", kind)
        and not STATED.search(f"{kind} {text}")
        and (function.split(".")[-1], name) not in ANY_QUANTITY
    ]


@each("module", parse_package)
def test_every_public_name_has_a_docstring(module):
    missing = [
        name
        for name, node in public(parse_package()[module])
        if not ast.get_docstring(node)
    ]
    assert missing == []


@each("module", list_physics)
def test_parameters_of_the_physics_state_their_unit(module):
    found = [
        fault
        for name, node in public(parse_package()[module])
        if isinstance(node, ast.FunctionDef)
        for fault in unstated(name, ast.get_docstring(node) or "")
    ]
    assert found == []


@each("module", list_physics)
def test_documented_parameters_are_those_of_the_function(module):
    for name, node in public(parse_package()[module]):
        documented = sections(ast.get_docstring(node) or "").get("Parameters")
        if documented and isinstance(node, ast.FunctionDef):
            names = [one for entry in entries(documented) for one in split(entry[0])]
            arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
            assert sorted(names) == sorted(
                argument.arg
                for argument in arguments
                if argument.arg not in ("self", "cls")
            ), name


def test_tests_named_in_docstrings_exist():
    named = {
        (module, line.removeprefix("tests/"))
        for module, tree in parse_package().items()
        for _, node in public(tree)
        for line in re.findall(
            r"[\w/]+\.py",
            " ".join(sections(ast.get_docstring(node) or "").get("Verified by", [])),
        )
    }
    missing = {one for one in named if not (ROOT / "tests" / one[1]).is_file()}
    assert named
    assert missing == set()


def split(names: str) -> list[str]:
    return [name.strip() for name in names.split(",")]


def test_the_physics_documents_its_parameters():
    """Otherwise the tests above would pass on nothing."""
    documented = [
        name
        for module, tree in parse_package().items()
        if module.startswith(PHYSICS)
        for name, node in public(tree)
        if "Parameters" in sections(ast.get_docstring(node) or "")
    ]
    assert len(documented) >= 10


# Rooms whose functions compute with arrays and physical numbers.
NUMERICAL = tuple(f"{room}/" for room in PHYSICS if room != "checks")
NUMBER = re.compile(r"\b(float|Floats|Ints|Mask|Signs|NDArray|Point)\b")
# What a class is made of, as in ``NetGeometry[float]``: its own page tells the units.
MADE_OF = re.compile(r"\b(?!Sequence|Mapping|Iterable|Iterator)[A-Z]\w*\[[^\[\]]*\]")
ARRAY = re.compile(r"\b(Floats|Ints|Mask|Signs|NDArray)\b")
# A shape as "shape (2, n)" or "(n_dofs,)".
SHAPE = re.compile(r"\bshape\b|\((?:\.\.|\w+)(?: [-+] \d)?,[^()]*\)")
AROUND_THE_NOUN = re.compile(r"(?:What|Why|Which|How|Of|Where|Whether|And|That|As)\b")


# Places that were not read yet for this.
OPEN = (
    *("study/effects.py", "study/notes.py"),
    *("envelope/rows.py", "site/model.py"),
)


def annotations(node: ast.ClassDef | ast.FunctionDef) -> dict[str, str]:
    """Annotation of each field of a class, or of each argument."""
    if isinstance(node, ast.ClassDef):
        named = {c.target.id: c.annotation for c in node.body if is_field(c)}
    else:
        given = node.args
        every = [*given.posonlyargs, *given.args, *given.kwonlyargs]
        named = {one.arg: one.annotation for one in every if one.annotation}
    return {name: ast.unparse(value) for name, value in named.items()}


def is_field(node: ast.stmt) -> bool:
    return isinstance(node, ast.AnnAssign) and "ClassVar" not in ast.unparse(node)


def silent(name: str, node: ast.ClassDef | ast.FunctionDef) -> list[str]:
    """Numbers and arrays, among them a returned one, without unit and shape."""
    heading = "Attributes" if isinstance(node, ast.ClassDef) else "Parameters"
    docstring = ast.get_docstring(node) or ""
    described = {
        one: f"{kind} {text}"
        for names, kind, text in entries(sections(docstring).get(heading, []))
        for one in split(names)
    }
    found = [
        f"{name}({one})"
        for one, annotation in annotations(node).items()
        if NUMBER.search(MADE_OF.sub("", annotation)) and "Callable" not in annotation
        if not STATED.search(described.get(one, ""))
    ]
    returned = getattr(node, "returns", None)
    if returned is not None and ARRAY.match(ast.unparse(returned)):
        about = docstring.partition("\nParameters\n")[0]
        about += "".join(kind for _, kind, _ in returns(docstring))
        found += [] if SHAPE.search(about) else [f"{name} returns"]
    return found


def returns(docstring: str) -> list[tuple[str, str, str]]:
    """Entries of what is returned; their kind stands in the place of a name."""
    found = entries(sections(docstring).get("Returns", []))
    return [("", f"{name} {kind}", text) for name, kind, text in found]


@each("module", list_numerical)
def test_numbers_of_the_numerical_rooms_state_unit_or_shape(module):
    """Of functions their arguments and arrays returned, of classes their fields."""
    found = [
        fault
        for name, node in public(parse_package()[module])
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
        for fault in silent(name, node)
    ]
    assert found == []


@each("module", lambda: [name for name in parse_package() if name not in OPEN])
def test_docstrings_begin_with_their_noun(module):
    documented = ast.Module | ast.ClassDef | ast.FunctionDef
    found = [
        docstring.splitlines()[0]
        for node in ast.walk(parse_package()[module])
        if isinstance(node, documented) and (docstring := ast.get_docstring(node))
        if AROUND_THE_NOUN.match(docstring)
    ]
    assert found == []


def refuses(node: ast.FunctionDef) -> bool:
    """The function raises, or calls a guard, and its docstring does not say so."""
    calls = {one.func.id for one in ast.walk(node) if is_call(one)}
    raises = any(isinstance(one, ast.Raise) and one.exc for one in ast.walk(node))
    guarded = any(name.lstrip("_").startswith("require_") for name in calls)
    documented = "Raises" in sections(ast.get_docstring(node) or "")
    return (raises or guarded) and not documented


def is_call(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name)


@each("module", list_numerical)
def test_functions_of_the_numerical_rooms_tell_what_they_refuse(module):
    found = [
        name
        for name, node in public(parse_package()[module])
        if isinstance(node, ast.FunctionDef) and refuses(node)
    ]
    assert found == []


def test_a_refusal_that_is_not_told_is_found():
    source = "def f(a):\n    require_positive('a', a)\ndef g():\n    raise ValueError\n"
    told = (
        'def h():\n    """H.\n\n    Raises\n    ------\n    E\n    """\n    raise E\n'
    )
    functions = ast.parse(source + told + "def k():\n    f()\n").body
    assert [refuses(node) for node in functions] == [True, True, False, False]


def test_a_silent_number_is_found():
    source = '''
def f(law: Law, force: Floats, angle: float) -> Floats:
    """F.

    Parameters
    ----------
    law : Law
        L.
    force : ndarray, shape (n,)
        F.
    angle : float
        A.
    """


def g(law: Law) -> Floats:
    """Forces (n_dofs,) of a law."""


class A:
    """A."""

    length: float
    name: str
'''
    (f, g, a) = ast.parse(source).body
    assert silent("f", f) == ["f(angle)", "f returns"]
    assert silent("g", g) == []
    assert silent("A", a) == ["A(length)"]


EXAMPLE = """Find something.

Parameters
----------
angle : float
    Of the slope [rad].
bare : float
    Of the slope, which
    is steep.
places : ndarray, shape (2, n)
    Where.
tolerance : float
    Gap over the length.
kind : str
    Its name.

Returns
-------
float
    Nothing here counts.
"""


def test_a_missing_unit_is_found():
    assert unstated("find", EXAMPLE) == ["find(bare)"]
    assert unstated("judge", "x\n\nParameters\n-----\nlow, high : float\n    x") == []


def test_a_missing_docstring_is_found():
    source = '"""M."""\ndef f():\n    pass\nclass A:\n    "A."\n    def g(self): pass\n'
    found = {name: ast.get_docstring(node) for name, node in public(ast.parse(source))}
    assert found == {"module": "M.", "f": None, "A": "A.", "A.g": None}


def test_examples_of_the_package_are_collected_as_tests():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    options = project["tool"]["pytest"]["ini_options"]
    assert "--doctest-modules" in options["addopts"].split()
    assert "netdesign" in options["testpaths"]
    parser = doctest.DocTestParser()
    examples = [
        example
        for tree in parse_package().values()
        for _, node in public(tree)
        for example in parser.get_examples(ast.get_docstring(node) or "")
    ]
    assert any(example.want for example in examples)
