from pathlib import Path

import pytest

VARY = """
[vary."block.mass_kg"]
uniform = [1.0, 12.0]

[vary.friction]
fields = ["feet.floor.static_friction", "feet.floor.dynamic_friction"]
uniform = [0.15, 0.5]
"""


@pytest.fixture
def vary() -> str:
    """What varies in `short_scene`; some of its samples fail."""
    return VARY


@pytest.fixture
def short_scene(tmp_path: Path) -> Path:
    """Experiment 2, cut to a second."""
    import surefoot

    path = tmp_path / "short.toml"
    path.write_text(surefoot.Scene("experiment-2").replaced({"duration_s": 1.0}).text)
    return path
