"""The programs inside the page: our modules of viewer/, and dygraphs, which draws the plots that zoom.

All of it stands in the page itself: modules as an import map of data URLs, which browsers take from a file on a disk, too.
"""

import base64
import json
import re
from pathlib import Path

VIEWER = Path(__file__).resolve().parent / "viewer"
# Beside our modules where jostle was packed with it; else Debian's package libjs-dygraphs.
PLACES = (VIEWER / "dygraphs", Path("/usr/share/javascript/dygraphs"))
MISSING = "Plots do not zoom, because dygraphs is not there: apt-get install libjs-dygraphs"


def style():
    return (VIEWER / "page.css").read_text(encoding="utf-8")


def modules():
    """The import map, and the start of the page's own program."""
    urls = {f"viewer/{path.name}": _url(path) for path in sorted(VIEWER.glob("*.js"))}
    return (f'<script type="importmap">{json.dumps({"imports": urls})}</script>\n'
            '<script type="module">import "viewer/main.js";</script>\n')


def plotting():
    """dygraphs and its style as elements of the page, or None where it is not installed."""
    for place in PLACES:
        program, look = place / "dygraph.min.js", place / "dygraph.min.css"
        if program.exists() and look.exists():
            return f"<style>{_inline(look)}</style>\n<script>{_inline(program)}</script>\n"
    return None


def described(told):
    """A description for the programs, as an element."""
    return '<script type="application/json" id="run">' + json.dumps(told).replace("</", "<\\/") + "</script>\n"


def packed(elements):
    return "".join(f'<script type="text/plain" id="{name}">{content}</script>\n' for name, content in elements.items())


def _url(path):
    return "data:text/javascript;base64," + base64.b64encode(path.read_bytes()).decode()


def _inline(path):
    """Without the name of a source map, which a browser's tools would ask for."""
    text = re.sub(r"(//# sourceMappingURL=.*|/\*# sourceMappingURL=.*?\*/)", "", path.read_text(encoding="utf-8"))
    return text.replace("</script", "<\\/script")
