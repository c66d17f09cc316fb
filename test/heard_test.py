"""The cues tell what can have been heard: by a sound device, or by whoever reads them."""
import subprocess

import pytest

QUEUED, STARTED, DROPPED = "0", "1", "4"


def stages(master, folder, device, *words):
    """The stages of the words that feedback_node has when nothing comes from a robot for 2 s."""
    config = folder / "alsoft"
    config.write_text(f"[general]\ndrivers = {device}\n[wave]\nfile = {folder}/sound.wav\n")
    env = dict(master, ALSOFT_CONF=str(config))
    echo = subprocess.Popen(["rostopic", "echo", "-p", "/navvi/cues"], env=env, stdout=subprocess.PIPE, text=True)
    node = subprocess.Popen(["rosrun", "navvi_feedback", "feedback_node", "_input:=topic", "_cues/patience:=2", *words], env=env,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        node.wait(8)
    except subprocess.TimeoutExpired:
        node.terminate()
    echo.terminate()
    lines = [line.split(",") for line in echo.communicate()[0].splitlines()]
    names = lines[0] if lines else []
    rows = [dict(zip(names, line)) for line in lines[1:]]
    return [row["field.stage"] for row in rows if row["field.modality"] == "0"]


def test_words_are_started_where_there_is_a_device(master, tmp_path):
    assert STARTED in stages(master, tmp_path, "wave")


def test_words_without_a_device_were_dropped(master, tmp_path):
    found = stages(master, tmp_path, "none")
    assert set(found) == {QUEUED, DROPPED}


def test_there_are_no_words_where_sound_is_off(master, tmp_path):
    assert stages(master, tmp_path, "wave", "_speech:=false") == []


def test_who_reads_them_hears_without_a_device(master, tmp_path):
    assert STARTED in stages(master, tmp_path, "none", "_speech:=false", "_listener:=topic")
