"""The documentation cannot rot: what it quotes, links to and says of files and codes is true."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from typer.main import get_command

from springcad.cli.app import app
from springcad.errors import InfeasibleError, OutputError, SpecError

ROOT = Path(__file__).parents[2]


def _generator() -> ModuleType:
    spec = importlib.util.spec_from_file_location("docs_generate", ROOT / "docs/generate.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


docs = _generator()
PAGES: list[Path] = docs.pages()
RENEW = "run `python docs/generate.py` and read the difference"


def _id(page: Path) -> str:
    return str(page.relative_to(ROOT))


README = ROOT / "README.md"


AGAIN = "**The warning of S2.**"
"""From here on the README designs S2 anew, over the files of its first command."""


@pytest.fixture(scope="module")
def readme_run(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """The README up to ``AGAIN`` with what its commands print, and the folder they ran in, once."""
    folder = tmp_path_factory.mktemp("readme")
    text = README.read_text(encoding="utf-8")
    return docs.with_output_in(folder, text.partition(AGAIN)[0]), folder


@pytest.fixture(scope="module")
def s2(readme_run: tuple[str, Path]) -> Path:
    """The folder of files that the README's command makes."""
    return readme_run[1] / "out/S2"


@pytest.mark.parametrize("page", PAGES, ids=_id)
def test_generated_reference_is_current(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert docs.with_reference(text) == text, RENEW
    markers = re.findall("<!-- generated: (.*) -->", text)
    assert markers == [name for _, name, _ in docs._GENERATED.findall(text)]


def _pages_with_commands() -> list[Any]:
    """Every page with a command but the README; what designs something is slow."""
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        if "```console" in text and page != README:
            marks = [pytest.mark.slow] if docs.designs(text) else []
            found.append(pytest.param(page, id=_id(page), marks=marks))
    return found


@pytest.mark.parametrize("page", _pages_with_commands())
def test_every_command_prints_what_the_page_shows(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert docs.with_output(text) == text, RENEW


@pytest.mark.slow
def test_the_commands_of_the_readme_print_what_it_shows(readme_run: tuple[str, Path]) -> None:
    first, again, rest = README.read_text(encoding="utf-8").partition(AGAIN)
    assert again
    assert readme_run[0] == first, RENEW
    assert docs.with_output(rest) == rest, RENEW


@pytest.mark.slow
def test_picture_is_the_drawing_that_the_demo_writes(s2: Path) -> None:
    drawing = (s2 / "S2.svg").read_text(encoding="utf-8")
    assert drawing == docs.PICTURE.read_text(encoding="utf-8"), RENEW


# Links


def _outside_fences(text: str) -> str:
    return re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)


def _links(page: Path) -> Iterator[str]:
    text = _outside_fences(page.read_text(encoding="utf-8"))
    yield from re.findall(r"\]\(([^)\s]+)\)", text)


def _anchors(page: Path) -> set[str]:
    """Anchors of the headings, as GitHub makes them."""
    headings = re.findall(
        r"^#+ (.*)$", _outside_fences(page.read_text(encoding="utf-8")), re.MULTILINE
    )
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=_id)
def test_every_relative_link_resolves(page: Path) -> None:
    for link in _links(page):
        if re.match(r"https?:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.is_file(), link
        assert target.is_relative_to(ROOT), link
        assert not anchor or anchor in _anchors(target), link


def test_every_page_can_be_reached_from_the_readme() -> None:
    reached: set[Path] = set()
    todo = [README]
    while todo:
        page = todo.pop()
        if page in reached or page.suffix != ".md":
            continue
        reached.add(page)
        todo += [
            (page.parent / link.partition("#")[0]).resolve()
            for link in _links(page)
            if not re.match(r"https?:|#", link)
        ]
    assert set(PAGES) == reached


FILES = re.compile(
    r"`((?:unit|property|validation|convergence|cli|robustness)/test_\w+\.py"
    r"|(?:springcad|bench|tests|docs|specs)/[\w/.-]+)`"
)


@pytest.mark.parametrize("page", PAGES, ids=_id)
def test_every_file_of_the_project_that_a_page_names_is_there(page: Path) -> None:
    for name in FILES.findall(page.read_text(encoding="utf-8")):
        path = ROOT / "tests" / name if "/test_" in name and name[:5] != "tests" else ROOT / name
        assert path.exists(), name


# Commands in running text


def _commands_in_text() -> Iterator[tuple[str, str]]:
    for page in PAGES:
        for span in re.findall(r"`springcad ([a-z][^`]*)`", page.read_text(encoding="utf-8")):
            yield _id(page), span


def test_commands_and_options_in_running_text_exist() -> None:
    commands: Mapping[str, Any] = get_command(app).commands  # type: ignore[attr-defined]
    found = list(_commands_in_text())
    assert found
    for page, span in found:
        name, *rest = span.split()
        assert name in commands, (page, span)
        command = commands[name]
        if rest and rest[0] in getattr(command, "commands", {}):
            command = command.commands[rest.pop(0)]
        known = {option for parameter in command.params for option in parameter.opts}
        options = {word.partition("=")[0] for word in rest if word.startswith("-")}
        assert options <= known | {"-", "--help"}, (page, span)


def test_make_targets_in_text_exist() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z]+):", makefile, re.MULTILINE))
    for page in PAGES:
        used = re.findall(r"(?:^|`)make ([a-z]+)", page.read_text(encoding="utf-8"), re.MULTILINE)
        assert set(used) <= targets, _id(page)


def test_the_workflow_of_the_tutorial_is_yaml_and_runs_what_exists() -> None:
    from ruamel.yaml import YAML

    text = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    steps = YAML(typ="safe").load(block)["jobs"]["design"]["steps"]
    (run,) = (s["run"] for s in steps if s.get("run", "").startswith("springcad"))
    assert run == "springcad design specs -o out --format github"


# Claims about codes, files and keys


def test_exit_codes_are_those_of_the_program() -> None:
    page = (ROOT / "docs/reference/exit-codes.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| (\d+) \| ([^|]+?) \|", page, re.MULTILINE))
    epilog = " ".join((app.info.epilog or "").split())
    known = dict(re.findall(r"(\d+) ([a-z][^;.]*)", epilog.split("Of several")[0]))
    assert set(rows) == set(known)
    for code, words in known.items():
        # the page says more where the help has room for a word only
        assert rows[code].startswith(words.split(" (")[0]), code
    assert (SpecError.exit_code, InfeasibleError.exit_code, OutputError.exit_code) == (3, 4, 6)


@pytest.mark.slow
def test_files_are_those_of_a_design(s2: Path) -> None:
    written = {path.name for path in s2.iterdir()}
    page = (ROOT / "docs/reference/files.md").read_text(encoding="utf-8")
    named = {name.replace("NAME", "S2") for name in re.findall(r"^\| `([^`]+)` \|", page, re.M)}
    assert named == written
    table = README.read_text(encoding="utf-8").split("## What you get")[1]
    in_readme = {
        name
        for row in re.findall(r"^\| (`[^|]+) \|", table.split("\n## ")[0], re.M)
        for name in re.findall(r"`([^`]+)`", row)
    }
    assert in_readme == written


def _keys(report: dict[str, Any]) -> set[str]:
    keys = set(report)
    sections = ("design", "design.flexure", "design.camshaft", "response")
    for section in (*sections, "verification", "provenance"):
        inner = report
        for part in section.split("."):
            inner = inner[part]
        keys |= {f"{section}.{key}" for key in inner}
    return keys


@pytest.mark.slow
def test_every_key_of_the_report_is_documented_and_none_else(
    s2: Path, tmp_path: Path, run_springcad: Callable[..., subprocess.CompletedProcess[str]]
) -> None:
    report = json.loads((s2 / "report.json").read_text(encoding="utf-8"))
    page = (ROOT / "docs/reference/report-json.md").read_text(encoding="utf-8")
    rubbing = ("--set", "camshaft.friction=0.1", "-o", tmp_path)
    assert run_springcad("design", ROOT / "specs/S1.yaml", *rubbing, "--no-verify").returncode == 0
    with_friction = json.loads((tmp_path / "S1/report.json").read_text(encoding="utf-8"))
    with_friction["verification"] = report["verification"]
    always, only_with_friction, rest = re.split(
        "^Only with `camshaft.friction`|^## ver", page, flags=re.M
    )
    row = re.compile(r"^\| `([^`]+)` \|", re.MULTILINE)
    assert set(row.findall(always + rest)) == _keys(report)
    assert set(row.findall(only_with_friction)) == _keys(with_friction) - _keys(report)
    for entry, listed in (("checks", report["checks"]), ("outcomes", report["outcomes"])):
        line = next(line for line in page.splitlines() if line.startswith(f"| `{entry}` |"))
        told = set(re.findall(r"`([^`]+)`", line)) - {entry, "null"}
        assert told == set(listed[0]), entry


@pytest.mark.slow
def test_claims_in_prose_hold_for_the_shipped_specs(s2: Path) -> None:
    """The design stress at full load within 0.5 %; one warning; arcs near rest below 1 µm."""
    report = json.loads((s2 / "report.json").read_text(encoding="utf-8"))
    assert report["response"]["peak_nominal_stress_Pa"] == pytest.approx(912e6, rel=5e-3)
    assert 0.0 < report["design"]["camshaft"]["preload_m"] < 1e-6
    assert [check["name"] for check in report["checks"] if check["status"] == "warn"] == [
        "root fillet stress against yield",
    ]


def test_the_readme_names_every_kind_and_none_else() -> None:
    from springcad.kinds import KINDS

    table = README.read_text(encoding="utf-8").split("## Start")[0]
    assert re.findall(r"^\| `([a-z0-9-]+)` \|", table, re.M) == list(KINDS)
