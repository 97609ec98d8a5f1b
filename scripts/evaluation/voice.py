"""What the robot understands of commands by voice: voices of espeak-ng that were not listened to when its bounds were chosen, amid noise like a
hall's; and how often it takes talk for a command."""
import os
import random
import subprocess
import tempfile
import wave
from pathlib import Path

import numpy as np

from evaluation.tables import Verdict, print_table

RATE = 22050  # [Hz] of espeak-ng
VOICES = ["en-us+m3", "en-gb-x-rp", "en-us+f2", "en-029+f4"]  # VoiceParams were chosen with en-us, en-gb, en-gb-scotland, en-us+f3 and en-us+m7
NOISES = [("quiet", 30.0), ("hall", 15.0), ("loud", 8.0)]  # [dB] of the voice above the noise
TALK = ["where are the toilets please", "that is a very nice machine", "i want an ice cream now", "we have to leave in ten minutes", "come here and look at this",
        "is it allowed to take photographs", "my feet hurt can we sit down", "who has built this thing", "he said that he would come later", "when does the museum close today",
        "it moves all by itself", "do not touch the robot", "we saw this on television", "what time is it", "mummy can it hear us"]
BEGINNINGS = {"exhibit": ["take me to", "show me", "go to", "drive to", "I would like to see"], "tour": ["start the tour", "give me the tour", "take the tour"]}
MOST_OF_TALK = 0.05
ANSWERS = [("tell me more", "more"), ("go on", "next"), ("stop the tour", "end_tour")]


def names(museum):
    """[(kind, id, English title)] of a museum's exhibits and tours."""
    import yaml
    read = yaml.safe_load((museum / "museum.yaml").read_text())
    return [("exhibit", one["id"], one["title"]["en"]) for one in read["exhibits"] if not one.get("web_only")] + \
           [("tour", one["id"], one["title"]["en"]) for one in read["tours"]]


def commands(museum, rng, count):
    """[(what is said, what is meant)]"""
    found = []
    known = names(museum)
    for i in range(count):
        if i % 6 == 5:
            found.append(rng.choice(ANSWERS))
            continue
        kind, identity, title = known[i % len(known)]
        polite = rng.choice(["", "please "])
        found.append((f"{polite}{rng.choice(BEGINNINGS[kind])} {title}", f"{kind} {identity}"))
    return found


def say(voice, text, rng, folder):
    """Samples, as loud as each other."""
    spoken = folder / "spoken.wav"
    subprocess.run(["espeak-ng", "-v", voice, "-s", str(rng.randint(130, 165)), "-p", str(rng.randint(35, 65)), "-w", spoken, "--", text], check=True)
    with wave.open(str(spoken)) as file:
        samples = np.frombuffer(file.readframes(file.getnframes()), dtype=np.int16).astype(float)
    return np.concatenate([np.zeros(RATE // 3), samples / np.sqrt((samples ** 2).mean()) * 2500.0, np.zeros(RATE // 3)])


def with_noise(samples, decibels, noise_rng, path):
    """Pink noise, which falls with frequency as the murmur of a hall does."""
    spectrum = np.fft.rfft(noise_rng.normal(size=len(samples)))
    noise = np.fft.irfft(spectrum / np.sqrt(np.arange(len(spectrum)) + 1.0), len(samples))
    noise *= np.sqrt((samples ** 2).mean()) / 10.0 ** (decibels / 20.0) / noise.std()
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(np.clip(samples + noise, -32767, 32767).astype(np.int16).tobytes())


def understood(docent, museum, recordings, *options):
    """[what was understood]: "exhibit zuse", "perhaps exhibit zuse", "no command"."""
    done = subprocess.run([docent, "listen", "--museum", museum, *options, *recordings], check=True, capture_output=True, text=True)
    lines = done.stdout.splitlines()
    assert len(lines) == len(recordings), done.stdout
    return [line.split(": ", 1)[1].split(' ("')[0] for line in lines]


def part(docent, root, options, verdict):
    rng = random.Random(options.first_seed)
    noise_rng = np.random.default_rng(options.first_seed)
    count = 12 if options.slice else 60
    museums = [root / "museums" / name for name in (["bonn"] if options.slice else ["bonn", "smithsonian"])]
    noises = NOISES[1:2] if options.slice else NOISES
    tally = {noise: {"said": 0, "right": 0, "asked": 0, "wrong": 0, "talk": 0, "acted": 0} for noise, _ in noises}
    careless = {"talk": 0, "acted": 0}  # what takes anything for a command
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for museum in museums:
            said = []
            for voice in VOICES[:2] if options.slice else VOICES:
                for text, meant in commands(museum, rng, count) + [(talk, "") for talk in rng.sample(TALK, 5 if options.slice else len(TALK))]:
                    samples = say(voice, text, rng, folder)
                    for noise, decibels in noises:
                        path = folder / f"{len(said):05d}.wav"
                        with_noise(samples, decibels, noise_rng, path)
                        said.append((path, noise, meant))
            for (path, noise, meant), heard in zip(said, understood(docent, museum, [path for path, _, _ in said])):
                seen = tally[noise]
                if not meant:
                    seen["talk"] += 1
                    seen["acted"] += heard not in ("no command",) and not heard.startswith("perhaps ")
                    continue
                seen["said"] += 1
                seen["right"] += heard == meant
                seen["asked"] += heard == "perhaps " + meant
                seen["wrong"] += heard not in ("no command", meant) and not heard.startswith("perhaps ")
            talk = [path for path, noise, meant in said if not meant and noise == "hall"]
            careless["talk"] += len(talk)
            careless["acted"] += sum(heard != "no command" for heard in understood(docent, museum, talk, "--acts-above", "-1000"))
    print_table(["noise", "above it, dB", "commands", "right", "right after asking back", "another", "talk", "taken for a command"],
                [[noise, decibels, seen["said"], seen["right"], seen["asked"], seen["wrong"], seen["talk"], seen["acted"]]
                 for (noise, decibels), seen in zip(noises, tally.values())])
    for noise in [noise for noise, _ in noises if noise != "loud"]:
        seen = tally[noise]
        obeyed = seen["right"] + seen["asked"]
        verdict.want(f"{noise}: at least 95 % of the commands are understood, some after asking back", f"{obeyed} of {seen['said']}", obeyed >= 0.95 * seen["said"])
        most_wrong = max(1 if options.slice else 0, 0.01 * seen["said"])
        verdict.want(f"{noise}: at most 1 % are taken for another", f"{seen['wrong']} of {seen['said']}", seen["wrong"] <= most_wrong)
        verdict.want(f"{noise}: at most 5 % of what is no command is taken for one", f"{seen['acted']} of {seen['talk']}", seen["acted"] <= MOST_OF_TALK * seen["talk"])
    verdict.want("one that acts on whatever it hears takes more than that for commands", f"{careless['acted']} of {careless['talk']}",
                 careless["acted"] > MOST_OF_TALK * careless["talk"])
    return verdict


def protocol(docent, root, options):
    verdict = Verdict()
    print(f"\n## voice: {'a slice' if options.slice else 'whole'}, seed {options.first_seed}\n", flush=True)
    part(os.fspath(docent), root, options, verdict)
    verdict.print()
    return verdict
