"""The short form of the soak: kills, a full disk, two writers, spoilt files do no harm; and harm is counted."""

import os

import pytest

from soak import __main__ as soak
from soak import kills, spoilt
from soak.counts import Counts

pytestmark = pytest.mark.skipif(os.name == "nt", reason="limits and pipes of Unix")


def test_the_short_form_finds_no_harm(tmp_path):
    found = list(soak.rows(tmp_path, quick=True))
    assert [one.failures for one in found] == [[]] * len(found)
    assert sum(one.harm() for one in found) == 0
    assert {one.abuse: one.tried for one in found} == {
        "SIGKILL at an event of the file system": 1,
        "SIGKILL at any time": 1,
        "two processes, 60 writes to one folder": 1,
        "full disk, by a limit of file size": 1,
        "spoilt files": len(list(spoilt.kinds(13))),
        "hostile names through every medium": 191,
    }
    assert kills.session(os.getpid() + 2**20) == []


def test_there_are_thirty_kinds_of_spoilt_file_and_more():
    assert len({name for _, name, _ in spoilt.kinds()}) >= 30
    assert len(list(spoilt.kinds())) >= 90


def test_harm_is_counted_and_told():
    counts = Counts("kills")
    counts.judge("first", lost=0, unnamed=False)
    counts.judge("second", lost=2, unnamed=True)
    assert (counts.tried, counts.lost, counts.unnamed, counts.harm()) == (2, 2, 1, 3)
    assert counts.failures == ["kills, second: lost, unnamed"]
    assert "| kills | 2 | 2 | 0 | 0 | 1 | 0 |" in soak.page([counts])
