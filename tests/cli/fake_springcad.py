"""springcad with a kind that designs in no time: a script for tests of everything around a design.

``behaviour`` in the spec chooses what happens; ``size`` makes one design differ from another.
"""

from __future__ import annotations

import os
import sys
import time
from types import ModuleType
from typing import Annotated, Literal

from pydantic import Field

import springcad.kinds
from springcad.__main__ import main
from springcad.errors import InfeasibleError
from springcad.spec.common import CommonSpec, Length, ProcessEntry

TEMPLATE = """\
springcad: 1
kind: fake
name: fake
size: 20 mm
process: laser
"""


class FakeSpec(CommonSpec):
    kind: Literal["fake"]
    size: Length
    process: ProcessEntry
    behaviour: Annotated[str, Field()] = "good"


def check_spec(spec):
    from springcad.result import check

    size = spec.model.size
    return (check("size", size, "<=", 0.1, "m", source="test", remedy="make it smaller"),)


def design_spec(spec, progress):
    from springcad.geometry.outline import Circle, Line, Outline, Profile
    from springcad.result import Outcome, Part, Result, check

    progress("thinking")
    size = spec.model.size
    match spec.model.behaviour:
        case "bug":
            raise RuntimeError(f"[bold]unforeseen[/bold]\nin {spec.name}")
        case "infeasible":
            raise InfeasibleError("size", 2 * size, size, "m", ("lower size to 10 mm",))
        case "slow":
            sys.stderr.write("at work\n")
            sys.stderr.flush()
            time.sleep(60)
        case "die":
            os.abort()
    half = size / 2
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    sides = [Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    plate = Profile(Outline(tuple(sides)), (Circle((0.0, 0.0), half / 2),))
    limit = {"fail": half, "warn": half}.get(spec.model.behaviour, 1.0)
    otherwise = "warn" if spec.model.behaviour == "warn" else "fail"
    held = check("size", size, "<=", limit, "m", source="test", otherwise=otherwise)
    return Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design={"size_m": size, "behaviour": spec.model.behaviour},
        response={},
        checks=(held,),
        outcomes=(Outcome("size", size, "m"),),
        parts=(Part("", "plate", plate, 0.002, "steel"),),
    )


def judge_design(design, progress):
    """Area of the plate as drawn, against its size; ``disagree`` is 1 % off."""
    import numpy as np

    from springcad.geometry.polyline import signed_area
    from springcad.result import Comparison, Judgement, check

    progress("weighing")
    size = design.number("design.size_m")
    area = sum(abs(signed_area(line)) * (1, -1)[i] for i, line in enumerate(design.contours[""]))
    expected = size**2 - np.pi * (size / 4) ** 2
    factor = 1.01 if design.text("design.behaviour") == "disagree" else 1.0
    comparison = Comparison(
        "area", "m^2", "size", "m", np.array([size]), np.array([expected]),
        np.array([factor * area]), 1e-3, True, "from the size; from the drawing",
    )  # fmt: skip
    found = check("second opinion: drawings", 1.0, ">=", 1.0, "1", source="test")
    return Judgement("weighing", (comparison,), (found,), ("The plate is flat.",), {"plates": 1})


def judge_decks(design):
    return {"area": f"** {design.name}\n"}


package, models = ModuleType("fake_kind"), ModuleType("fake_kind.spec")
package.SPEC_MODEL = models.SPEC_MODEL = FakeSpec
package.TEMPLATE, package.check_spec, package.design_spec = TEMPLATE, check_spec, design_spec
package.judge_design, package.judge_decks = judge_design, judge_decks
sys.modules |= {"fake_kind": package, "fake_kind.spec": models}
springcad.kinds.KINDS["fake"] = ("fake_kind", "a plate with a hole, for tests")

if __name__ == "__main__":
    main()
