"""Starting springcad: help, version, wrong usage, and what is loaded for them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import springcad

Run = Callable[..., "subprocess.CompletedProcess[str]"]
COMMANDS = ["design", "check", "preflight", "init", "schema", "materials", "kinds", "doctor"]


def loaded_packages(*arguments: str, cwd: Path) -> set[str]:
    """Packages that have been imported at the end of a run of springcad."""
    script = (
        "import sys\n"
        "from springcad.cli.run import run\n"
        "run(sys.argv[1:])\n"
        "names = [n for n, module in sys.modules.items() if module is not None]\n"
        "print('LOADED', *{n.split('.')[0] for n in names})\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", script, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=True,
    )
    loaded = set(run.stdout.splitlines()[-1].split())
    assert {"LOADED", "springcad"} <= loaded
    return loaded


@pytest.mark.parametrize("command", [[], *([name] for name in COMMANDS)])
def test_help_of_every_command(run_springcad: Run, command: list[str]) -> None:
    run = run_springcad(*command, "--help")
    assert run.returncode == 0
    assert run.stdout.startswith("Usage: springcad")
    assert run.stderr == ""


def test_help_names_every_command_and_exit_code(run_springcad: Run) -> None:
    text = " ".join(run_springcad("--help").stdout.split())
    assert all(re.search(rf"\b{name}\b", text) for name in COMMANDS)
    assert "3 spec invalid; 4 no feasible design; 5 designed and written, but a check" in text


def test_help_loads_nothing_heavy(tmp_path: Path) -> None:
    heavy = {"numpy", "scipy", "shapely", "ezdxf", "pint", "pydantic", "rich", "ruamel", "jinja2"}
    assert loaded_packages("--help", cwd=tmp_path) & heavy == set()
    heavy.remove("pydantic")  # typer itself reads the options of a command with it
    assert loaded_packages("design", "--help", cwd=tmp_path) & heavy == set()


@pytest.mark.parametrize("command", ["design", "check"])
def test_a_spec_error_loads_nothing_numeric(tmp_path: Path, command: str) -> None:
    (tmp_path / "a.yaml").write_text("springcad: 1\nkind: rotary-flexure\nnmae: a\n")
    heavy = {"numpy", "scipy", "shapely", "ezdxf", "jinja2"}
    assert loaded_packages(command, "a.yaml", cwd=tmp_path) & heavy == set()


def test_version(run_springcad: Run) -> None:
    run = run_springcad("--version")
    assert (run.returncode, run.stdout, run.stderr) == (
        0,
        f"springcad {springcad.__version__}\n",
        "",
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "Missing command"),
        (["desing"], "desing"),
        (["design"], "SPEC"),
        (["design", "a.yaml", "--nope"], "--nope"),
        (["design", "a.yaml", "--format", "html"], "html"),
        (["init", "rotary-flexur"], "unknown kind rotary-flexur; did you mean rotary-flexure?"),
        (["preflight", "a.dxf", "--process", "lasr"], "did you mean laser?"),
    ],
)
def test_wrong_usage_is_2_with_one_line_and_a_hint(
    run_springcad: Run, arguments: list[str], message: str
) -> None:
    run = run_springcad(*arguments)
    assert run.returncode == 2
    assert run.stdout == ""
    error, hint = run.stderr.splitlines()
    assert error.startswith("error: ")
    assert message in error
    assert re.fullmatch(r"try 'springcad.* --help'", hint)


def test_kinds_and_materials_and_schema_go_to_stdout(run_springcad: Run) -> None:
    for command, expected in [
        (["kinds"], "rotary-flexure"),
        (["materials"], "aisi-420"),
        (["schema"], "draft-07"),
        (["doctor"], springcad.__version__),
    ]:
        run = run_springcad(*command)
        assert (run.returncode, run.stderr) == (0, "")
        assert expected in run.stdout


def test_every_material_value_has_a_source(run_springcad: Run) -> None:
    materials = json.loads(run_springcad("materials", "--json").stdout)
    steel = materials["aisi-420"]
    assert steel["elastic_modulus"]["value"] == 200e9
    for material in materials.values():
        values = [value for value in material.values() if isinstance(value, dict)]
        assert len(values) >= 4
        assert all(value["source"] for value in values)


def test_schema_is_json(run_springcad: Run) -> None:
    assert "draft-07" in json.loads(run_springcad("schema").stdout)["$schema"]


def test_init_writes_a_spec_and_never_over_another(run_springcad: Run, tmp_path: Path) -> None:
    first = run_springcad("init", "rotary-flexure")
    assert (first.returncode, first.stdout) == (0, "")
    path = tmp_path / "rotary-flexure.yaml"
    template = path.read_text(encoding="utf-8")
    assert template.startswith("#") or "springcad: 1" in template

    path.write_text("mine")
    second = run_springcad("init", "rotary-flexure")
    assert second.returncode == 6
    assert "is there already; --force replaces it" in second.stderr
    assert path.read_text() == "mine"

    assert run_springcad("init", "rotary-flexure", "--force").returncode == 0
    assert path.read_text(encoding="utf-8") == template
    assert run_springcad("init", "rotary-flexure", "-o", "-").stdout == template


def test_the_spec_of_init_passes_check(run_springcad: Run) -> None:
    assert run_springcad("init", "rotary-flexure", "-o", "my spec.yaml").returncode == 0
    assert run_springcad("check", "my spec.yaml").returncode == 0


def test_a_reader_that_leaves_early_is_no_error(tmp_path: Path) -> None:
    """``springcad materials | head -1``: it has seen what it wanted."""
    run = subprocess.Popen(
        [sys.executable, "-m", "springcad", "materials"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=tmp_path,
    )
    assert run.stdout is not None
    assert run.stderr is not None
    run.stdout.close()
    assert run.stderr.read() == b""
    assert run.wait() == 0
    run.stderr.close()


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
@pytest.mark.parametrize("command", ["materials", "--version"])
def test_a_full_disk_behind_stdout_is_6(tmp_path: Path, command: str) -> None:
    with open("/dev/full", "w") as full:
        run = subprocess.run(
            [sys.executable, "-m", "springcad", command],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert run.returncode == 6
    assert run.stderr == "error: cannot write to standard output: No space left on device\n"


@pytest.mark.parametrize(
    "env",
    [{"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "C"}, {"TERM": "dumb"}, {"COLUMNS": "20"}],
)
def test_poor_terminals_get_a_result_all_the_same(run_springcad: Run, env: dict[str, str]) -> None:
    run = run_springcad("materials", env=env)
    assert (run.returncode, run.stderr) == (0, "")


def test_no_colour_where_it_is_not_a_terminal(run_springcad: Run) -> None:
    assert "\x1b" not in run_springcad("materials").stdout
