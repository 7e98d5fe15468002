"""A page as a browser prints it: how many pages, and what is too wide for them."""

import contextlib
import re
import subprocess
import zlib

from tests.programs import require_program

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
PAPER_PX = 695  # width of the print area at 96 dots per inch: 210 mm less both margins
PHONE_PX = 400
A4_PT, FOOTER = 841.92, 0.948  # height of a page, share of it above all footers
PRINTED_PX = 1036  # height of the print area: 297 mm less both margins
_STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
_STEP = re.compile(
    rb"^(?:([qQ])|[-\d.]+ \S+ \S+ ([-\d.]+) [-\d.]+ ([-\d.]+) (cm|Tm))$", re.MULTILINE
)
_QUIET = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage")
# What lies further right than the page, each with the section that it stands in; what
# a section scrolls counts too.
_MEASURE = """<script>
document.body.style.width = "WIDTHpx";
const found = [];
for (const one of document.querySelectorAll("table, svg, p, li, dl, figure, h2, h3")) {
  if (one.getBoundingClientRect().right <= WIDTH + 1) continue;
  const place = one.closest("[id]");
  found.push(place.id + " " + one.tagName.toLowerCase());
}
document.body.innerHTML = "<pre>" + found.join("\\n") + "</pre>";
</script></body>"""


def count_pages(page: str, folder) -> int:
    """Pages on A4."""
    target = folder / "report.pdf"
    open_page(page, folder, f"--print-to-pdf={target}", "--no-pdf-header-footer")
    return len(re.findall(rb"/Type\s*/Page\b", target.read_bytes()))


def measure_pages(page: str, folder) -> list[float]:
    """Lowest word of each page that is not its footer, as a share of the page."""
    target = folder / "measured.pdf"
    open_page(page, folder, f"--print-to-pdf={target}", "--no-pdf-header-footer")
    found = []
    for stream in _STREAM.findall(target.read_bytes()):
        with contextlib.suppress(zlib.error):
            heights = list(_list_heights(zlib.decompress(stream)))
            if heights:
                found.append(max((h for h in heights if h < FOOTER), default=0.0))
    return found


def _list_heights(text: bytes):
    """Height of each word from the top of its page; drawings have scales of their own.

    A browser's pages are scaled and moved (cm) inside of brackets (q Q), never turned.
    """
    scale, move, outer = 1.0, 0.0, []
    for bracket, upright, shift, kind in _STEP.findall(text):
        if bracket == b"q":
            outer.append((scale, move))
        elif bracket == b"Q":
            scale, move = outer.pop()
        elif kind == b"cm":
            scale, move = scale * float(upright), move + scale * float(shift)
        else:
            yield 1.0 - (move + scale * float(shift)) / A4_PT


_BOTTOM = """<script>
document.body.style.width = "WIDTHpx";
const box = document.querySelector("SELECTOR").getBoundingClientRect();
document.body.innerHTML = "<pre>" + box.bottom + "</pre>";
</script></body>"""


def measure_bottom(page: str, selector: str, folder) -> float:
    """Lower edge of an element on paper, from the top of the first page [px]."""
    script = _BOTTOM.replace("WIDTH", str(PAPER_PX)).replace("SELECTOR", selector)
    return float(_ask(_as_on_paper(page), script, folder))


def list_too_wide(page: str, width: int, folder, media: str = "print") -> list[str]:
    """``section tag`` of whatever reaches beyond ``width`` [px] on that medium."""
    page = _as_on_paper(page) if media == "print" else page
    script = _MEASURE.replace("WIDTH", str(width))
    return _ask(page, script, folder, f"--window-size={width},2000").splitlines()


def _as_on_paper(page: str) -> str:
    """The page with what it has for print, shown on a screen."""
    page = page.replace("@media print", "@media all")
    return page.replace("@media screen", "@media speech")


def _ask(page: str, script: str, folder, *arguments: str) -> str:
    """What a script at the end of a page leaves of it, as text."""
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    page = page.replace("</body>", script)
    tree = open_page(page, folder, *arguments, "--dump-dom")
    (told,) = re.findall("<pre>(.*?)</pre>", tree, flags=re.DOTALL)
    return told


# Texts of drawings that share more than half a pixel of width and a quarter of their
# height, and those that leave their drawing.
_MEETING = """<script>
const found = [];
for (const svg of document.querySelectorAll("svg[role=img]")) {
  const title = ": " + svg.getAttribute("aria-label").split(".")[0];
  const frame = svg.getBoundingClientRect();
  const boxes = [];
  for (const text of svg.querySelectorAll("text")) {
    const a = text.getBoundingClientRect(), name = text.textContent.trim();
    if (!a.width || !name) continue;
    for (const [b, other] of boxes) {
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const tall = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (wide > 0.5 && tall > Math.min(a.height, b.height) / 4)
        found.push(name + " / " + other + title);
    }
    if (a.left < frame.left - 1 || a.right > frame.right + 1
        || a.top < frame.top - 2 || a.bottom > frame.bottom + 2)
      found.push(name + title);
    boxes.push([a, name]);
  }
}
document.body.innerHTML = "<pre>" + found.join("\\n") + "</pre>";
</script></body>"""


def list_meeting(drawings: list[str], folder) -> list[str]:
    """Labels that meet in the drawings' SVG, and those beyond its edges."""
    style = "body { font-family: Arial, sans-serif; } svg { display: block; }"
    figures = "".join(f"<figure>{svg}</figure>" for svg in drawings)
    page = f"<html><style>{style}</style><body>{figures}</body></html>"
    return _ask(page, _MEETING, folder).splitlines()


_HIDDEN = """<script>
const gone = [...document.querySelectorAll("section")].filter(
  (one) => getComputedStyle(one).display === "none").map((one) => one.id);
document.body.innerHTML = "<pre>" + gone.join("\\n") + "</pre>";
</script></body>"""


def list_hidden(page: str, folder) -> set[str]:
    """Sections that paper does not show."""
    page = page.replace("@media print", "@media all")
    return set(_ask(page, _HIDDEN, folder).split())


def open_page(page: str, folder, *arguments: str) -> str:
    """What the browser prints of a page."""
    path = folder / "page.html"
    path.write_text(page, encoding="utf-8")
    return run_browser(path, *arguments).stdout


def run_browser(path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The browser's run on a page, with a profile beside it."""
    return subprocess.run(
        [
            require_program(*NAMES),
            *_QUIET,
            f"--user-data-dir={path.parent}/profile",
            *arguments,
            path.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
