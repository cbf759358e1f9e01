"""Every exported name has an `Examples` section, and what stands there holds."""

import doctest

import pytest

import suspension_ctrl as sc


@pytest.mark.parametrize("name", sc.__all__)
def test_examples_of_an_exported_name_hold(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # some write a file
    tests = doctest.DocTestFinder().find(getattr(sc, name), name)
    (own,) = [test for test in tests if test.name == name]
    assert "Examples\n" in own.docstring
    assert own.examples
    for test in tests:
        report: list[str] = []
        failed, _ = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=report.append)
        assert not failed, "".join(report)
