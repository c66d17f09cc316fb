#!/usr/bin/env python3
"""Writes down what is heard in a recording of a session: `test/hearing.py sound.wav` prints onset and words.

A speech recogniser with a grammar made from the phrase file listens to each stretch of sound between two silences.
"""
import array
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

PHRASES = pathlib.Path(__file__).resolve().parent.parent / "navvi_ws/src/navvi_feedback/config/phrases/en.yaml"
DICTIONARY = pathlib.Path("/usr/share/pocketsphinx/model/en-us/cmudict-en-us.dict")
RATE = 16000  # Hz, of the recogniser's model
ONES = ("zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen "
        "seventeen eighteen nineteen").split()
TENS = "twenty thirty forty fifty sixty seventy eighty ninety".split()


def number_words(number):
    """The words of a number from 0 to 999, or with one decimal."""
    whole, _, fraction = number.partition(".")
    hundreds, value = divmod(int(whole), 100)
    if hundreds:
        return [ONES[hundreds], "hundred"] + (["and"] + number_words(str(value)) if value else [])
    words = [ONES[value]] if value < 20 else [TENS[value // 10 - 2]] + ([ONES[value % 10]] if value % 10 else [])
    return words + (["point", ONES[int(fraction)]] if fraction else [])


def words_of(text):
    """The words of a cue as they are spoken."""
    words = []
    for word in re.findall(r"[a-z']+|\d+(?:\.\d+)?", text.lower()):
        words += number_words(word) if word[0].isdigit() else [word]
    return words


def grammar(told):
    """The phrase file as a JSGF grammar, with what is told in lessons if that is `told`."""
    document = yaml.safe_load(PHRASES.read_text())
    words = document["words"]
    choices = {
        "direction": " | ".join(" ".join(words_of(words[f"clock_{hour}"])) for hour in range(1, 13)),
        "way": "<direction> | straight ahead",
        "distance": "<number> meters | one meter | <number> point five meters | zero point five meters",
        "thing": " | ".join(words[key] for key in
                            ("shelf", "wall", "box", "pedestal", "worker", "forklift", "pallet_robot", "other")),
        "a_thing": " | ".join(value for key, value in words.items() if key.startswith("a_")),
        "stick": "the stick | the keys",
        "more": "up | page up",
        "less": "down | page down",
        "place": " | ".join(value + " [<number>]" for key, value in words.items() if key.startswith("place_")),
        "setting": " | ".join(value for key, value in words.items() if key.startswith("setting_")),
        "value": "<ones> hundred [and] [<number>] | <number> | <number> percent | one hundred percent | "
                 + " | ".join(value for key, value in words.items() if key.startswith("value_")),
        "person": "anna",
        "side": " | ".join(value for key, value in words.items() if key.startswith("side_")),
        "where": " | ".join(value for key, value in words.items() if key.startswith("where_")),
    }
    lines = ["#JSGF V1.0;", "grammar cues;", f"<ones> = {' | '.join(ONES[1:])};",
             f"<number> = <ones> | ({' | '.join(TENS)}) [{' | '.join(ONES[1:10])}];"]
    lines += [f"<{name}> = {value};" for name, value in choices.items()]
    cues = []
    known = {line.split()[0] for line in DICTIONARY.read_text().splitlines()}
    lessons = document["lessons"]
    names = [words_of(name) for key, name in lessons.items() if key.startswith(("pad_", "key_"))]
    lines.append(f"<button> = {' | '.join(sorted(set(map(' '.join, names))))};")
    sentences = [sentence for key, text in lessons.items() if told and not key.startswith(("pad_", "key_")) for sentence in text.split(". ")]
    for template in [*(text for part in ("phrases", "again", "clock") for text in document[part].values()), *sentences]:
        text = re.sub(r"[.,]", " ", template.lower())
        text = re.sub(r"\d+", lambda digits: " ".join(number_words(digits.group())), text)
        text = re.sub(r"\{(count|all)\}", "<number>", text)
        text = re.sub(r"\{(?!direction|way|distance|thing|a_thing|stick|more|less|place|side|where|setting|value|person)(\w+)\}", "<button>", text)
        # The recogniser refuses a grammar with a word that it does not know, such as "odometry".
        if set(re.findall(r"[a-z']+", re.sub(r"\{\w+\}|<\w+>", " ", text))) <= known:
            cues.append(re.sub(r"\{(\w+)\}", r"<\1>", text))
    return "\n".join(lines + [f"<cue> = {' | '.join(cues)};",
                               "public <cues> = <cue>+;"])  # cues may follow on one another at once


def stretches(loud, gap):
    """The (first, last) of runs of sorted numbers with no gap of more than `gap`."""
    while loud:
        end = next((i for i in range(1, len(loud)) if loud[i] - loud[i - 1] > gap), len(loud))
        yield loud[0], loud[end - 1]
        loud = loud[end:]


def utterances(samples, quiet=300, gap=0.22):
    """Yields (first, last) sample of each stretch that is louder than `quiet`, joined over gaps of `gap` s. A tick, alone for
    0.03 s on both sides and shorter than 0.08 s, is no word."""
    block = RATE // 100
    loud = [at for at in range(0, len(samples) - block, block)
            if max(max(samples[at:at + block]), -min(samples[at:at + block])) > quiet]
    words = [at for first, last in stretches(loud, 0.03 * RATE) if last - first >= 0.07 * RATE
             for at in range(first, last + block, block)]
    for first, last in stretches(words, gap * RATE):
        yield first, last + block


def transcribe(path, told=False):
    """Returns a list of (onset in s, words) for a sound file."""
    raw = subprocess.check_output(["sox", "--ignore-length", str(path), "-t", "raw", "-r", str(RATE), "-e", "signed", "-b", "16",
                                   "-c", "1", "-"], stderr=subprocess.DEVNULL)
    samples = array.array("h", raw[:len(raw) // 2 * 2])
    spans = [span for span in utterances(samples) if span[1] - span[0] >= 0.2 * RATE]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "cues.jsgf").write_text(grammar(told))
        (folder / "all").write_text("".join(f"{index}\n" for index in range(len(spans))))
        for index, (first, last) in enumerate(spans):
            (folder / f"{index}.raw").write_bytes(samples[first:last].tobytes())
        # No word for noise, which swallows words; each utterance at its own loudness.
        subprocess.run(["pocketsphinx_batch", "-adcin", "yes", "-cepdir", name, "-cepext", ".raw", "-ctl", name + "/all", "-hyp", name + "/heard",
                        "-jsgf", name + "/cues.jsgf", "-fsgusefiller", "no", "-cmn", "batch",
                        "-beam", "1e-100", "-wbeam", "1e-80", "-pbeam", "1e-100", "-logfn", "/dev/null"], check=True)
        lines = (folder / "heard").read_text().splitlines() if spans else []
    return [(first / RATE, line.rsplit("(", 1)[0].split()) for (first, _), line in zip(spans, lines)]


if __name__ == "__main__":
    for onset, heard_words in transcribe(sys.argv[1]):
        print(f"{onset:8.2f}  {' '.join(heard_words)}")
