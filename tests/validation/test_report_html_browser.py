"""report.html in a real browser: it loads without a network, breaks no rule, and shows its text."""

from __future__ import annotations

import html
import re
import subprocess

import pytest
from report_example import DRAWING, FILES, example_result

from springcad.report.html import result_to_html

pytestmark = pytest.mark.slow


@pytest.fixture
def browse(require_tool, tmp_path):
    """``browse(text)``: the document after loading, and what the browser's console said."""
    chromium = require_tool("chromium")
    profile = tmp_path / "profile"

    def run(text):
        page = tmp_path / "page.html"
        page.write_text(text, encoding="utf-8")
        done = subprocess.run(
            [
                chromium,
                *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic"),
                *("--no-first-run", "--disable-background-networking", "--disable-sync"),
                *("--disable-component-update", "--disable-dev-shm-usage"),
                "--host-resolver-rules=MAP * ~NOTFOUND",
                "--enable-logging=stderr",
                f"--user-data-dir={profile}",
                "--dump-dom",
                page.as_uri(),
            ],
            capture_output=True,
            text=True,
            timeout=120,
            check=True,
        )
        return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]

    return run


@pytest.fixture(scope="module")
def report():
    return result_to_html(example_result(), DRAWING, FILES)


def test_the_page_loads_without_a_word_from_the_console(browse, report):
    document, console = browse(report)
    assert console == []
    assert "1 of 15 checks fails" in document
    assert len(re.findall('<path class="curve', document)) == 10


def test_the_policy_stops_scripts_and_fetches_that_slip_in(browse, report):
    intruder = '<script>document.title = "taken"</script><img src="https://example.org/x.png">'
    document, console = browse(report.replace("<main>", f"<main>{intruder}"))
    assert "<title>s2: " in document
    assert len([line for line in console if "Content Security Policy" in line]) == 2


@pytest.mark.parametrize("width", [400, 1200])
def test_all_text_is_visible_and_the_page_never_scrolls_sideways(browse, report, width):
    # The page may not run scripts, so that a page around it measures it.
    frame = f'<iframe width="{width}" height="900" style="border:0" srcdoc="{html.escape(report)}">'
    measure = """</iframe><pre id="out"></pre><script>
    onload = () => {
      const page = document.querySelector("iframe").contentDocument;
      document.getElementById("out").textContent =
        page.documentElement.scrollWidth - page.documentElement.clientWidth
        + "\\n" + page.body.innerText;
      document.querySelector("iframe").remove();
    }</script>"""
    document, console = browse(f"<!DOCTYPE html><meta charset=utf-8>{frame}{measure}")
    assert console == []
    hidden_width, shown = re.search(r'<pre id="out">(\d+)\n(.*?)</pre>', document, re.S).groups()
    assert hidden_width == "0"
    shown = html.unescape(shown)
    result = example_result()
    for claim in result.checks:
        assert claim.name in shown
        assert claim.remedy in shown
    for sentence in (*result.assumptions, *result.advice):
        assert sentence in shown
