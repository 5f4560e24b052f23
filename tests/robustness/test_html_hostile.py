"""report.html is one closed file: nothing is fetched, nothing runs, every name stays text."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from html.parser import HTMLParser

import numpy as np
import pytest
from report_example import DRAWING, FILES, example_result

from springcad.export.svg import result_to_svg
from springcad.report.html import result_to_html
from springcad.result import Check, Outcome, Part, Plot, Result, Series

HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "'><svg/onload=alert(1)>",
    "{{7*7}}{% raw %}{#",
    "</style><style>body{display:none}",
    "</pre></title></svg>--><!--",
    "javascript:alert(1)",
    "&lt;b&gt; &amp;amp;",
    "[bold red]",
]


class Page(HTMLParser):
    """Tags with their attributes, and all text, as a browser would see them."""

    VOID = frozenset({"meta", "br", "img", "link", "path", "circle"})

    def __init__(self, html):
        super().__init__()
        self.tags, self.text, self.open = [], "", []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}> closes another element"

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.text += data


def page(result=None, files=FILES):
    return Page(result_to_html(result or example_result(), DRAWING, files))


def poisoned(text):
    """A result that carries ``text`` in every string that a user or a file could have given."""

    def poison(value):
        match value:
            case str():
                return text
            case dict():
                return {f"{key}{text}": poison(item) for key, item in value.items()}
            case tuple() | list():
                return type(value)(poison(item) for item in value)
            case Check():
                return replace(value, name=text, source=text, remedy=text, unit=text)
            case Outcome():
                return replace(value, label=text, note=text, unit=text)
            case Part():
                return replace(value, suffix=text, role=text, material=text)
            case Plot():
                return replace(
                    value,
                    title=text,
                    x_label=text,
                    y_label=text,
                    x_unit=text,
                    series=poison(value.series),
                )
            case Series():
                return replace(value, label=text)
        return value

    clean = example_result()
    return Result(**{f.name: poison(getattr(clean, f.name)) for f in fields(Result)})


def test_the_page_needs_nothing_from_outside():
    html = result_to_html(example_result(), DRAWING, FILES)
    without_namespace = html.replace('xmlns="http://www.w3.org/2000/svg"', "")
    for outside in ("http:", "https:", "//", "url(", "@import", "<script", "<link", "<iframe"):
        assert outside not in without_namespace
    fetching = {"src", "href", "srcset", "xlink:href", "data", "action", "background", "poster"}
    for _, attributes in page().tags:
        assert not fetching & set(attributes)


def test_the_policy_forbids_everything_but_the_style_sheet():
    policies = [
        attributes["content"]
        for tag, attributes in page().tags
        if attributes.get("http-equiv") == "Content-Security-Policy"
    ]
    assert policies == ["default-src 'none'; style-src 'unsafe-inline'; img-src data:"]


def test_the_drawing_stands_in_the_page_without_its_xml_declaration():
    html = result_to_html(example_result(), DRAWING, FILES)
    assert "<?" not in html
    assert ("svg", "71mm") in [(tag, attributes.get("width")) for tag, attributes in page().tags]


def test_no_element_carries_a_script():
    for tag, attributes in page().tags:
        assert tag != "script"
        assert not [name for name in attributes if name.startswith("on")]


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_names_stay_text(text):
    hostile = page(poisoned(text), {text: text})
    clean = page()
    assert [tag for tag, _ in hostile.tags] == [
        tag for tag, _ in page(poisoned("name"), {"name": "name"}).tags
    ], "a name added or removed elements"
    assert hostile.open == clean.open == []
    assert hostile.text.count(text) > 60


def test_control_and_bidirectional_characters_do_not_reach_the_page():
    html = result_to_html(poisoned("a\x1b\x00\u202eb\ud800"), DRAWING, {})
    assert not re.search("[\x00-\x09\x0b-\x1f\u202e\ud800]", html)
    html.encode("utf-8")


def test_verdict_remedies_numbers_and_sources_are_all_told():
    text = page().text
    result = example_result()
    assert text.index("1 of 15 checks fails") < text.index("Drawing")
    for claim in result.checks:
        assert claim.name in text
        assert claim.source in text
        assert claim.remedy in text
    for sentence in (*result.assumptions, *result.advice, *FILES, *FILES.values()):
        assert sentence in text
    assert "148.5\N{NO-BREAK SPACE}N\N{MIDDLE DOT}m/rad" in text
    assert "stiffness: 150 N*m/rad" in text


def test_sections_come_in_the_order_in_which_people_ask():
    headings = re.findall(r"<h2>(.*?)</h2>", result_to_html(example_result(), DRAWING, FILES))
    assert headings == [
        "Drawing",
        "Results and targets",
        "Curves",
        "Second opinion: finite elements",
        "Checks",
        "Assumed and not checked",
        "Advice",
        "Design",
        "Specification",
        "Files",
        "Provenance",
    ]


def test_the_same_result_gives_the_same_bytes():
    first, second = (result_to_html(example_result(), DRAWING, FILES) for _ in range(2))
    assert first == second


def test_a_result_with_nothing_but_a_name_is_still_a_page():
    bare = Result("rotary-flexure", "bare", {}, {}, {}, (), (), ())
    assert "Nothing was checked" in page(bare, {}).text


def test_a_plot_without_numbers_does_not_break_the_page():
    empty = Plot("t", "x", "m", "y", "m", (Series("s", np.array([]), np.array([])),))
    assert page(example_result(plots=(empty,))).open == []


@pytest.mark.parametrize(
    "drawing",
    ["", "<p>no drawing</p>", "<svg><script>alert(1)</script></svg>", "<svg><SCRIPT/></svg>"],
)
def test_a_drawing_that_is_none_is_refused(drawing):
    with pytest.raises(ValueError, match="drawing"):
        result_to_html(example_result(), drawing, FILES)


def test_the_real_drawing_with_hostile_names_adds_no_element():
    def tags(text):
        result = poisoned(text)
        return [t for t, _ in Page(result_to_html(result, result_to_svg(result), {})).tags]

    harmless = tags("name")
    assert all(tags(text) == harmless for text in HOSTILE)
