"""What axe (axe-core, MPL) finds in a page in a real browser; contrast of drawings."""

import re
from importlib.resources import files

from tests.report.printing import open_page

WHITE = (255, 255, 255)
_RUN = """<script>
axe.run({exclude: [["svg *"]]}).then((found) => {
  const told = document.createElement("pre");
  told.id = "told-by-axe";
  told.textContent = found.violations.map(
    (one) => one.id + ": " + one.nodes.map((node) => node.html).join(" ")
  ).join("\\n") + "\\n" + found.passes.length;
  document.body.append(told);
});
</script></body>"""


def list_violations(page: str, folder, width: int = 1100) -> list[str]:
    """Rules of axe that a page breaks at a width [px], each with where."""
    axe = files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    assert "</script" not in axe  # it would end there
    scripts = f"<script>{axe}</script>{_RUN}"
    page = scripts.join(page.rsplit("</body>", 1))
    wait = "--virtual-time-budget=60000"
    tree = open_page(page, folder, f"--window-size={width},2000", wait, "--dump-dom")
    (told,) = re.findall('<pre id="told-by-axe">(.*?)</pre>', tree, re.DOTALL)
    *violations, passed = told.split("\n")
    assert int(passed) > 20  # else nothing was examined
    return [one for one in violations if one]


def measure_contrast(colour: str, ground: tuple[int, int, int] = WHITE) -> float:
    """Contrast of two colours as WCAG 2 defines it, 1 to 21."""
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    pair = sorted((_measure_light((red, green, blue)), _measure_light(ground)))
    return (pair[1] + 0.05) / (pair[0] + 0.05)


def _measure_light(colour: tuple[int, int, int]) -> float:
    shares = [part / 255 for part in colour]
    linear = [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4
              for s in shares]  # fmt: skip
    return sum(w * s for w, s in zip((0.2126, 0.7152, 0.0722), linear, strict=True))
