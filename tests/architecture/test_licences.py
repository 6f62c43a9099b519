"""The page of licences names every dependency with its range of versions."""

from docs.licences import PAGE, PURPOSES, requirements


def test_every_dependency_is_on_the_page():
    text = PAGE.read_text(encoding="utf-8")
    for rows in requirements().values():
        for name, versions in rows:
            assert f"| {name} | {versions} |" in text, f"{name}: run python -m docs.licences"


def test_every_extra_has_a_purpose():
    assert set(requirements()) <= set(PURPOSES)
