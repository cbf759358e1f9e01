"""Counts of abuse and its consequences, as a row of a table."""

from dataclasses import dataclass, field


@dataclass
class Counts:
    """How often something was done to a campaign, and how often it did harm."""

    abuse: str
    tried: int = 0
    lost: int = 0  # finished runs
    repeated: int = 0  # finished runs
    differing: int = 0  # tables, from that of an undisturbed campaign
    unnamed: int = 0  # consequences that were not said in one line
    left: int = 0  # processes and unfinished files
    failures: list[str] = field(default_factory=list)

    def harm(self) -> int:
        """Return all that must be none."""
        return self.lost + self.repeated + self.differing + self.unnamed + self.left

    def judge(self, what: str, **harms: bool | int) -> None:
        """Count one more try, and its harms by the name of their column."""
        self.tried += 1
        for name, count in harms.items():
            setattr(self, name, getattr(self, name) + int(count))
        if any(harms.values()):
            self.failures.append(f"{self.abuse}, {what}: {', '.join(name for name in harms if harms[name])}")
