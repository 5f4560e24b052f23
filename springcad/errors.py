"""What can go wrong, as types with data; rendered once, in ``springcad.cli``."""

from __future__ import annotations

from dataclasses import dataclass


class SpringcadError(Exception):
    """A failure that is the user's to know about; ``exit_code`` is what the command returns."""

    exit_code = 1


@dataclass(frozen=True, order=True)
class Problem:
    """One thing wrong in a spec: where it stands and what to do (line and column count from 1)."""

    file: str
    line: int
    column: int
    message: str
    key: str = ""

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}:{self.column}: "
        return where + (f"{self.key}: {self.message}" if self.key else self.message)


class SpecError(SpringcadError):
    """The spec is invalid; all problems found are given at once, in the order of the file."""

    exit_code = 3

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = tuple(problems)


class InfeasibleError(SpringcadError):
    """No design can meet the spec: which limit, by how much, and verified changes that would help.

    ``value`` and ``limit`` are in SI; ``unit`` is their SI unit (``"1"`` for a ratio).
    """

    exit_code = 4

    def __init__(
        self, claim: str, value: float, limit: float, unit: str, remedies: tuple[str, ...] = ()
    ) -> None:
        super().__init__(claim)
        self.claim = claim
        self.value = value
        self.limit = limit
        self.unit = unit
        self.remedies = remedies

    def with_remedies(self, *more: str) -> InfeasibleError:
        """The same error with more remedies behind its own."""
        remedies = (*self.remedies, *more)
        return InfeasibleError(self.claim, self.value, self.limit, self.unit, remedies)


class OutputError(SpringcadError):
    """A file could not be written; what was there before is untouched."""

    exit_code = 6
