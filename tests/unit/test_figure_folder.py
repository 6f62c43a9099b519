"""The folder of figures holds those of the last run alone."""

from matplotlib.figure import Figure

from gearlube.plotting.figure_folder import save_figure_folder


def test_figures_of_an_earlier_run_do_not_stay(tmp_path):
    folder = tmp_path / "figures"
    save_figure_folder({"lines": Figure(figsize=(1, 1)), "bars": Figure(figsize=(1, 1))}, folder)
    assert save_figure_folder({"bars": Figure(figsize=(1, 1))}, folder) == [folder / "bars.png"]
    assert [path.name for path in folder.iterdir()] == ["bars.png"]
    assert save_figure_folder({}, folder) == []
    assert not folder.exists()


def test_what_no_study_drew_stays(tmp_path):
    (tmp_path / "mine.txt").write_text("a note")
    save_figure_folder({}, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
