# SPDX-License-Identifier: BSD-3-Clause
"""The tour runs, says what it should, and draws."""
import subprocess
import sys
from pathlib import Path

TOUR = Path(__file__).resolve().parents[2] / "python" / "examples" / "tour.py"


def test_tour(tmp_path):
    outcome = subprocess.run([sys.executable, str(TOUR), str(tmp_path)], capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
    assert "moved by [" in outcome.stdout and "tower" in outcome.stdout
    assert (tmp_path / "tour.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "map" / "hierarchy.yaml").exists()
