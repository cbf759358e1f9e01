"""Modules of JavaScript as one script: each once and before its users, in a scope of its own."""

import os
import shutil
import subprocess

import pytest

from suspension_ctrl.desk.explorer.bundling import bundled

BASE = """export const A = 1, B = 2, C = [3, 4];
const hidden = C[0];
export function sum() {
  return A + B + hidden;
}
"""
LEFT = """import { sum } from "./base.js";

const hidden = 4;
export class Left {
  value = sum() + hidden;
}
"""
MAIN = """import { A, B } from "./base.js";
import { Left } from "./left.js";
console.log(A, B, new Left().value);
"""
MODULES = {"base.js": BASE, "left.js": LEFT, "main.js": MAIN}


@pytest.fixture
def script(tmp_path) -> str:
    for name, text in MODULES.items():
        (tmp_path / name).write_text(text)
    return bundled(tmp_path / "main.js")


def test_each_module_stands_once_before_its_users(script):
    places = [script.index(f"modules.{name} =") for name in ("base", "left", "main")]
    assert places == sorted(places)
    assert all(script.count(f"modules.{name} =") == 1 for name in ("base", "left", "main"))


@pytest.mark.skipif(shutil.which("node") is None and "NO_SKIPS" not in os.environ, reason="needs Node")
def test_the_script_runs(script, tmp_path):
    (tmp_path / "script.cjs").write_text(script)
    done = subprocess.run(["node", tmp_path / "script.cjs"], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("1 2 10\n", "")
