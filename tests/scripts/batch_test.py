"""zskel batch as its users meet it, and what it must bear.

Usage: batch_test.py PROGRAM MODELS_DIR CASE...     batch_test.py --list names the cases
"""

import errno
import json
import os
import pty
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

QUICK = ["--backend", "cpu", "--face-px", "4", "--seeds", "60"]
# Sanitizers reserve terabytes of address space.
SANITIZED = "ZSKEL_SANITIZED" in os.environ
if SANITIZED:
    QUICK += ["--item-memory", "0"]
BY_EGL = ["--backend", "egl", *QUICK[2:]]
PATIENCE_S = 600
SMALL = ["cube_coarse", "capsule", "y", "torus"]


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def batch(*arguments, code=0, text=None, **named):
    """Runs a batch to its end; standard output and error as text."""
    done = subprocess.run(
        [PROGRAM, "batch", *arguments], capture_output=True, text=True, input=text, timeout=PATIENCE_S, **named
    )
    expect(done.returncode == code, f"exit code {done.returncode}, not {code}: {arguments}\n{done.stdout}{done.stderr}")
    return done


def summary(*arguments, code=0):
    """The summary of a batch, which must add up."""
    tally = json.loads(batch(*arguments, "--json", code=code).stdout)
    check_sum(tally)
    return tally


def check_sum(tally):
    parts = sum(tally[part] for part in ("ok", "warned", "failed", "skipped", "left"))
    expect(parts == tally["items"], f"the summary does not add up: {tally}")
    expect(sum(tally["reasons"].values()) == tally["failed"], f"reasons do not add up: {tally}")


def records(path="batch.jsonl"):
    """The last record of every output; every line must be whole but the last."""
    last = {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            record = json.loads(line)
            last[record["output"]] = record
    return last


def files(folder):
    return sorted(os.listdir(folder)) if os.path.isdir(folder) else []


def check_outputs(folder, expected):
    """These files are there, whole, and no other, hidden ones included."""
    expect(files(folder) == sorted(expected), f"files are there: {files(folder)}")
    for name in expected:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            expect(json.load(file)["format"] == "zskel-skeleton", f"{name} is no skeleton")


def graph(path):
    with open(path, encoding="utf-8") as file:
        skeleton = json.load(file)
    return skeleton["nodes"], skeleton["edges"]


def copy_models(folder="in", names=SMALL):
    os.makedirs(folder, exist_ok=True)
    for name in names:
        shutil.copy(f"{MODELS}/{name}.obj", f"{folder}/{name}.obj")


def start(*arguments):
    return subprocess.Popen(
        [PROGRAM, "batch", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL
    )


def state_of(pid):
    """The state's letter; an orphan that nobody has asked for stays as a zombie, Z."""
    try:
        with open(f"/proc/{pid}/stat", encoding="latin-1") as file:
            return file.read().rpartition(") ")[2][:1]
    except OSError:
        return ""


def workers_of(process):
    try:
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            return [pid for pid in map(int, file.read().split()) if state_of(pid) not in ("", "Z", "X")]
    except OSError:
        return []


def wait_until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not (met := condition()):
        expect(time.monotonic() < end, f"waited in vain for: {what}")
        time.sleep(0.01)
    return met


def signal_quietly(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def lines_of(path):
    try:
        with open(path, "rb") as file:
            return file.read().count(b"\n")
    except FileNotFoundError:
        return 0


# A pipe that nobody writes to holds up whoever opens it: an item that hangs.
def make_hanging(path):
    os.mkfifo(path)


def open_if_read(path):
    """A pipe's other end, once somebody reads from it; the reader then goes on waiting, for what is never written."""
    try:
        return os.open(path, os.O_WRONLY | os.O_NONBLOCK)
    except OSError as error:
        if error.errno != errno.ENXIO:
            raise
        return None


def case_hostile():
    copy_models()
    whole = open("in/y.obj", encoding="ascii").read()
    bad = {
        "cut": whole[: len(whole) // 3].rstrip("0123456789.-") + "\nv 1",
        "nan": "v nan 0 0\n" + whole,
        "empty": "",
        "binary": "\0\1\2",
        "far_index": "v 0 0 0\nf 1 2 99999999\n",
        "flat": "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n",
    }
    for name, text in bad.items():
        open(f"in/{name}.obj", "w", encoding="latin-1").write(text)
    os.mkdir("in/folder.obj.d")
    make_hanging("in/hang.obj")
    names = [f"in/{name}.obj" for name in [*SMALL, *bad, "hang", "absent"]]
    tally = json.loads(
        batch("-", *QUICK, "-o", "out/{stem}.json", "--item-timeout", "5", "--json", code=6, text="\n".join(names)).stdout
    )
    check_sum(tally)
    expect(tally["items"] == len(names), tally)
    expect(tally["failed"] == len(bad) + 2, f"not all bad ones failed: {tally}")
    expect(tally["reasons"] == {"bad_input": len(bad) + 1, "timeout": 1}, tally)
    check_outputs("out", [f"{name}.json" for name in SMALL])
    journal = records()
    expect(len(journal) == len(names), "not a line for each item")
    expect(journal["out/hang.json"]["exit_code"] == 7, journal["out/hang.json"])
    expect(journal["out/absent.json"]["exit_code"] == 3, journal["out/absent.json"])
    for name in SMALL:
        record = journal[f"out/{name}.json"]
        expect(record["backend"] == "cpu" and record["seconds"] > 0 and record["peak_memory_kib"] > 0, record)
        expect(re.fullmatch("[0-9a-f]{16}", record["key"]), record)


def case_manifests():
    copy_models()
    open("list.csv", "w").write('group,model,output\n"a, b",in/y.obj,\nc,in/torus.obj,special.swc\n')
    batch("list.csv", *QUICK, "-o", "{group}/{index}-{name}.json", "--journal", "a.jsonl")
    check_outputs("a, b", ["0-y.obj.json"])
    expect(open("special.swc").read().startswith("#"), "no SWC")
    open("list.jsonl", "w").write('{"model": "in/y.obj", "id": 7}\n{"model": "in/torus.obj", "id": 8}\n')
    batch("list.jsonl", *QUICK, "-o", "b/{id}.json", "--journal", "b.jsonl")
    check_outputs("b", ["7.json", "8.json"])
    batch("in", *QUICK, "-o", "c/{dir}/{stem}.json", "--journal", "c.jsonl")
    check_outputs("c/in", [f"{name}.json" for name in SMALL])
    batch("in/y.obj", "in/torus.obj", *QUICK, "-o", "d/{stem}", "--format", "json", "--journal", "d.jsonl")
    check_outputs("d", ["torus", "y"])
    expect(graph("d/y") == graph("c/in/y.json"), "another skeleton by another manifest")


def case_usage():
    copy_models()
    shutil.copytree("in", "more")
    before = files(".")
    refused = [
        (2, "the output of two models", ["in", "more", "-o", "out/{stem}.json"]),
        (2, "would replace", ["in", "-o", "{dir}/{name}", "--format", "obj"]),
        (2, "{bogus}", ["in", "-o", "{bogus}.json"]),
        (2, "--shard", ["in", "--shard", "0/2"]),
        (2, "--shard", ["in", "--shard", "3/2"]),
        (2, "--workers", ["in", "--workers", "0"]),
        (2, "--item-timeout", ["in", "--item-timeout", "-1"]),
        (2, "--step", ["in", "--step", "0.1"]),
        (2, ".xyz", ["in", "-o", "{stem}.xyz"]),
        (2, "manifest", []),
        (3, "none.txt", ["none.txt"]),
        (5, "no/batch.jsonl", ["in", "--journal", "no/batch.jsonl"]),
        (5, "no/r.html", ["in", "--report", "no/r.html"]),
    ]
    for code, piece, arguments in refused:
        done = batch(*arguments, code=code)
        expect(done.stdout == "" and done.stderr.count("\n") == 1, f"not one line: {arguments}\n{done.stderr}")
        expect(piece in done.stderr, f"the message lacks {piece}: {done.stderr}")
    expect(files(".") == before, f"something was made: {files('.')}")
    expect("Exit codes" in batch("--help").stdout, "no exit codes in --help")


def case_crash():
    copy_models()
    make_hanging("in/hang.obj")
    process = start("in", *QUICK, "-o", "out/{stem}.json", "--workers", "2", "--item-timeout", "0", "--json")
    wait_until(lambda: lines_of("batch.jsonl") == len(SMALL), "all others done")
    for worker in workers_of(process):
        signal_quietly(worker, signal.SIGABRT)  # which sanitizers leave alone
    out, err = process.communicate(timeout=PATIENCE_S)
    expect(process.returncode == 6, f"exit code {process.returncode}: {err}")
    tally = json.loads(out)
    check_sum(tally)
    expect(tally["ok"] + tally["warned"] == len(SMALL) and tally["reasons"] == {"crashed": 1}, tally)
    expect(records()["out/hang.json"]["exit_code"] == 128 + signal.SIGABRT, records()["out/hang.json"])
    check_outputs("out", [f"{name}.json" for name in SMALL])


def require_egl():
    if subprocess.run([PROGRAM, "extract", "in/y.obj", "--backend", "egl", "-o", "y.json", "-q"]).returncode:
        sys.exit(77)


def gpu_process_of(process):
    def is_it(pid):
        try:
            with open(f"/proc/{pid}/comm", encoding="ascii") as file:
                return file.read() == "zskel-gpu\n"
        except OSError:
            return False

    return next(filter(is_it, workers_of(process)), None)


def has_mapped(pid, library):
    try:
        with open(f"/proc/{pid}/maps", encoding="utf-8") as file:
            return library in file.read()
    except OSError:
        return False


def case_gpu():
    """The process that talks to the GPU gives what lone runs give; killed, it costs no item."""
    names = many_models(12)
    copy_models()
    require_egl()
    line = ["in", *BY_EGL, "-o", "out/{stem}.json", "--workers", "3", "--item-timeout", "0", "--json"]
    process = start(*line)
    wait_until(lambda: lines_of("batch.jsonl") >= 1, "an item")
    gpu = wait_until(lambda: gpu_process_of(process), "a GPU process")
    drivers = [pid for pid in workers_of(process) if has_mapped(pid, "libEGL")]
    expect(drivers == [gpu], f"{drivers} have loaded the driver, and not {gpu} alone")
    killed = set()
    for done in (1, 4, 8):
        wait_until(lambda: lines_of("batch.jsonl") >= done, f"{done} items")
        pid = wait_until(lambda: gpu_process_of(process), "a GPU process")
        signal_quietly(pid, signal.SIGKILL)
        killed.add(pid)
    out, err = process.communicate(timeout=PATIENCE_S)
    expect(process.returncode == 0 and len(killed) == 3, f"exit code {process.returncode}, killed {killed}: {err}")
    tally = json.loads(out)
    check_sum(tally)
    expect(tally["ok"] + tally["warned"] == len(names) + len(SMALL), tally)
    check_outputs("out", [f"{name}.json" for name in [*names, *SMALL]])
    for name in SMALL:
        lone = [PROGRAM, "extract", f"in/{name}.obj", *BY_EGL[:6], "-o", f"{name}.json", "-q"]
        expect(subprocess.run(lone, timeout=PATIENCE_S).returncode == 0, f"{name} alone")
        expect(graph(f"{name}.json") == graph(f"out/{name}.json"), f"{name} is not what a lone run gives")


def case_gpu_hangs():
    """A GPU process that hangs costs the items that wait for it, and no other."""
    names = many_models(8)
    copy_models()
    require_egl()
    process = start("in", *BY_EGL, "-o", "out/{stem}.json", "--workers", "2", "--item-timeout", "30" if SANITIZED else "8", "--json")
    wait_until(lambda: lines_of("batch.jsonl") >= 2, "two items")
    signal_quietly(gpu_process_of(process), signal.SIGSTOP)
    out, err = process.communicate(timeout=PATIENCE_S)
    tally = json.loads(out)
    check_sum(tally)
    expect(process.returncode == 6 and set(tally["reasons"]) == {"timeout"}, f"{tally} {err}")
    expect(tally["failed"] in (1, 2) and tally["left"] == 0 and tally["items"] == len(names) + len(SMALL), tally)


def case_lost_context():
    """The GPU is reset while items are worked on: they are tried again alone, where the third case loses that too."""
    copy_models()
    require_egl()
    line = ["in", *BY_EGL, "-o", "out/{stem}.json", "--workers", "1", "--json"]
    for after, failed in ((1, 0), (3, 1), (30, 0)):
        env = {**os.environ, "LD_LIBRARY_PATH": os.environ["ZSKEL_LOSING_EGL"], "ZSKEL_LOSE_AFTER": str(after)}
        journal = f"{after}.jsonl"
        done = subprocess.run([PROGRAM, "batch", *line, "--journal", journal], capture_output=True, text=True, env=env)
        expect("losing_egl: lost" in done.stderr, f"no context was lost after {after}: {done.stderr}")
        tally = json.loads(done.stdout)
        check_sum(tally)
        expect(tally["failed"] == failed and tally["ok"] + tally["warned"] == len(SMALL) - failed, tally)
        failures = [record for record in records(journal).values() if record["status"] == "failed"]
        for record in failures:
            expect(record["reason"] == "no_backend" and "was lost" in record["text"], record)
        shutil.rmtree("out")


def case_resume():
    copy_models()
    open("in/bad.obj", "w").write("v nan 0 0\n")
    line = ["in", *QUICK, "-o", "out/{stem}.json"]
    first = summary(*line, code=6)
    expect((first["ok"] + first["warned"], first["failed"]) == (len(SMALL), 1), first)
    again = summary(*line, code=6)
    expect((again["skipped"], again["failed_before"]) == (len(SMALL), 1), again)
    expect(lines_of("batch.jsonl") == len(SMALL) + 1, "what was skipped has another line")
    # What has changed is done anew, and nothing else.
    os.remove("out/y.json")
    shutil.copy("in/capsule.obj", "in/torus.obj")
    changed = summary(*line, code=6)
    expect((changed["ok"] + changed["warned"], changed["skipped"]) == (2, len(SMALL) - 2), changed)
    other = summary(*line, "--detail", "1.5", code=6)
    expect(other["skipped"] == 0, f"other options, old skeletons: {other}")
    retried = summary(*line, "--detail", "1.5", "--retry", code=6)
    expect((retried["failed"], retried["failed_before"]) == (1, 0), retried)
    shutil.copy("in/y.obj", "in/bad.obj")
    mended = summary(*line, "--detail", "1.5")
    expect((mended["ok"] + mended["warned"], mended["skipped"]) == (1, len(SMALL)), mended)
    # A journal whose last line is torn: that item is done again.
    with open("batch.jsonl", "rb+") as journal:
        journal.truncate(os.path.getsize("batch.jsonl") - 20)
    torn = summary(*line, "--detail", "1.5")
    expect((torn["ok"] + torn["warned"], torn["skipped"]) == (1, len(SMALL)), torn)
    check_outputs("out", [f"{name}.json" for name in [*SMALL, "bad"]])


def many_models(count, folder="in"):
    """Copies of small models, told apart by a comment."""
    os.makedirs(folder, exist_ok=True)
    texts = [open(f"{MODELS}/{name}.obj", encoding="ascii").read() for name in SMALL]
    names = [f"m{i:04}" for i in range(count)]
    for i, name in enumerate(names):
        open(f"{folder}/{name}.obj", "w", encoding="ascii").write(f"# {i}\n{texts[i % len(texts)]}")
    return names


def case_killed():
    names = many_models(60)
    line = ["in", *QUICK, "-o", "out/{stem}.json", "--workers", "2"]
    chance = random.Random(1)
    for _ in range(20):
        process = start(*line)
        workers = []
        goal = lines_of("batch.jsonl") + chance.randrange(3)
        wait_until(lambda: process.poll() is not None or lines_of("batch.jsonl") >= goal, "some lines")
        time.sleep(chance.random() * 0.05)
        workers = workers_of(process)
        process.kill()
        process.communicate()
        wait_until(lambda: all(state_of(pid) in ("", "Z", "X") for pid in workers), "workers die with their parent")
        for name in files("out"):
            if not name.startswith("."):
                graph(f"out/{name}")
    tally = summary(*line)
    expect(tally["items"] == len(names), tally)
    check_outputs("out", [f"{name}.json" for name in names])
    again = summary(*line)
    expect(again["skipped"] == len(names), again)


def case_shard():
    names = many_models(11)
    line = ["in", *QUICK]
    batch(*line, "-o", "whole/{stem}.json")
    items = 0
    for number in range(1, 4):
        items += summary(*line, "-o", "parts/{stem}.json", "--shard", f"{number}/3")["items"]
    expect(items == len(names), f"{items} items in all parts")
    check_outputs("parts", [f"{name}.json" for name in names])
    for name in names:
        expect(graph(f"parts/{name}.json") == graph(f"whole/{name}.json"), f"{name} differs")
    # The parts' journals are the whole's.
    with open("merged.jsonl", "w", encoding="utf-8") as merged:
        for number in range(1, 4):
            merged.write(open(f"batch.{number}-of-3.jsonl", encoding="utf-8").read())
    tally = summary(*line, "-o", "parts/{stem}.json", "--journal", "merged.jsonl")
    expect(tally["skipped"] == len(names), tally)


def case_signals():
    copy_models()
    hanging = "in/zz_hang.obj"  # the last: when a worker reads it, all others have had their turn
    make_hanging(hanging)
    line = ["in", *QUICK, "-o", "out/{stem}.json", "--workers", "2", "--item-timeout", "0", "--json"]
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        process = start(*line)
        wait_until(lambda: lines_of("batch.jsonl") == len(SMALL), "all others done")
        # Before that line is there, the first round's items are not; later rounds find them done at once.
        held = wait_until(lambda: open_if_read(hanging), "a worker at the pipe")
        workers = workers_of(process)
        for pid in [process.pid, *workers]:  # as a terminal or a cluster does
            signal_quietly(pid, number)
        out, err = process.communicate(timeout=PATIENCE_S)
        os.close(held)
        expect(process.returncode == 128 + number, f"exit code {process.returncode} after signal {number}: {err}")
        tally = json.loads(out)
        check_sum(tally)
        expect(tally["left"] == 1 and tally["failed"] == 0, tally)
        expect(all(state_of(pid) in ("", "Z", "X") for pid in workers), "a worker goes on")
        check_outputs("out", [f"{name}.json" for name in SMALL])
    os.remove(hanging)
    shutil.copy("in/y.obj", hanging)
    tally = summary(*line[:-1])
    expect((tally["ok"] + tally["warned"], tally["skipped"]) == (1, len(SMALL)), tally)


def case_memory():
    if SANITIZED:
        print("skipped: sanitizers reserve terabytes")
        sys.exit(77)
    copy_models()
    count = 800
    with open("in/large.obj", "w", encoding="ascii") as file:
        for y in range(count):
            for x in range(count):
                file.write(f"v {x} {y} {(x * y) % 7 * 0.1}\n")
        for y in range(count - 1):
            for x in range(count - 1):
                at = y * count + x + 1
                file.write(f"f {at} {at + 1} {at + count + 1} {at + count}\n")
    tally = summary("in", *QUICK, "-o", "out/{stem}.json", "--workers", "1", "--item-memory", "400", code=6)
    expect(tally["reasons"] == {"memory": 1}, tally)
    expect(records()["out/large.json"]["exit_code"] == 7, records()["out/large.json"])
    check_outputs("out", [f"{name}.json" for name in SMALL])


def case_lock():
    copy_models()
    make_hanging("in/hang.obj")
    process = start("in", *QUICK, "-o", "out/{stem}.json", "--item-timeout", "0")
    wait_until(lambda: lines_of("batch.jsonl") == len(SMALL), "all others done")
    expect("another batch" in batch("in", *QUICK, "-o", "out/{stem}.json", code=2).stderr, "two batches, one journal")
    process.kill()
    process.communicate()


def case_full():
    """A journal that cannot grow ends the batch with its exit code, and keeps what it has."""
    copy_models()
    limited = lambda: __import__("resource").setrlimit(__import__("resource").RLIMIT_FSIZE, (700, 700))
    done = batch("in", *QUICK, "-o", "/dev/null/d/{stem}.json", code=5)
    expect("cannot be made" in done.stderr, done.stderr)
    done = batch("in", *QUICK, "-o", "out/{stem}.json", "--workers", "1", code=5, preexec_fn=limited)
    expect("journal" in done.stderr, done.stderr)
    lines = open("batch.jsonl", "rb").read()
    expect(lines.endswith(b"\n") or not lines, "half a line")
    summary("in", *QUICK, "-o", "out/{stem}.json", "--retry")
    check_outputs("out", [f"{name}.json" for name in SMALL])


def case_report():
    copy_models()
    open("in/bad.obj", "w").write("v nan 0 0\n")
    batch("in", *QUICK, "-o", "out/{stem}.json", "--report", "r.html", "--thumbnails", "2", code=6)
    page = open("r.html", encoding="utf-8").read()
    pictures = page.count("data:image/png;base64,")
    expect(pictures == 1 or "Pictures are missing" in page, f"{pictures} pictures")  # bad.obj is one of the two
    expect("bad_input" in page and "http" not in page, "not a page of its own")
    nowhere = {**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "LD_LIBRARY_PATH": "/nonexistent"}
    batch("in", *QUICK, "-o", "b/{stem}.json", "--journal", "b.jsonl", "--report", "b.html", code=6, env=nowhere)
    page = open("b.html", encoding="utf-8").read()
    expect("data:image/png" in page or "Pictures are missing" in page, "neither pictures nor a reason")
    plain = json.loads(open("batch.jsonl", encoding="utf-8").readline())
    expect(set(plain) >= {"model", "output", "status", "reason", "warnings", "seconds", "backend", "key"}, plain)


def case_terminal():
    """A progress bar on a terminal, and on nothing else."""
    copy_models()
    expect("\r" not in batch("in", *QUICK, "-o", "a/{stem}.json", "--journal", "a.jsonl").stderr, "a bar in a file")
    for quiet in ([], ["-q"]):
        ours, theirs = pty.openpty()
        line = [PROGRAM, *quiet, "batch", "in", *QUICK, "-o", "b/{stem}.json", "--journal", f"b{len(quiet)}.jsonl"]
        process = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while piece := os.read(ours, 4096):
                shown += piece
        except OSError:
            pass  # Linux' way to say that the other end is closed
        os.close(ours)
        expect(process.wait(timeout=PATIENCE_S) == 0, "it failed")
        if quiet:
            expect(shown == b"", f"not quiet: {shown}")
        else:
            expect(re.search(rb"\[#* *\] \d/4 ", shown) and shown.endswith(b"\r\x1b[K"), f"no bar: {shown}")


def case_doctor():
    done = subprocess.run([PROGRAM, "doctor", "--json"], capture_output=True, text=True, timeout=PATIENCE_S, check=True)
    told = json.loads(done.stdout)["batch"]
    expect(1 <= told["workers"] <= told["cores"] and told["memory_share_mib"] > 0, told)
    expect(told["workers"] * told["memory_share_mib"] <= told["memory_mib"], told)


def reference_graphs():
    """What a lone run makes of each small model."""
    graphs = {}
    for name in SMALL:
        plain = [option for option in QUICK if option not in ("--item-memory", "0")]
        subprocess.run(
            [PROGRAM, "extract", f"{MODELS}/{name}.obj", *plain, "-o", f"{name}.reference.json"],
            check=True, timeout=PATIENCE_S, stderr=subprocess.DEVNULL,
        )
        graphs[name] = graph(f"{name}.reference.json")
    return graphs


def make_hostile(name, kind):
    texts = ["v nan 0 0\n", "", "v 0 0 0\nf 1 2 3\n", "\0\xff\1", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"]
    path = f"in/{name}.obj"
    os.remove(path)
    if kind == len(texts):
        make_hanging(path)
    else:
        open(path, "w", encoding="latin-1").write(texts[kind])


def disturb(process, chance):
    """Kills workers, and in the end the whole batch; true when that had come to its end by itself."""
    end = time.monotonic() + 0.5 + chance.random() * 4
    while process.poll() is None and time.monotonic() < end:
        time.sleep(chance.random() * 0.4)
        workers = workers_of(process)
        if workers and chance.random() < 0.5:
            signal_quietly(chance.choice(workers), chance.choice([signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT]))
    has_ended = process.poll() is not None
    if not has_ended:
        process.send_signal(chance.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGKILL, signal.SIGINT]))
    process.communicate(timeout=PATIENCE_S)
    return has_ended


def case_stress():
    """Long: 2,000 items, 5 % hostile, workers and the whole batch killed at random."""
    graphs = reference_graphs()
    names = many_models(2000)
    hostile = {name for i, name in enumerate(names) if i % 20 == 7}
    for i, name in enumerate(sorted(hostile)):
        make_hostile(name, i % 6)
    line = ["in", *QUICK, "-o", "out/{stem}.json", "--workers", "2", "--item-timeout", "1"]
    chance = random.Random(2)
    runs = 1
    while not disturb(start(*line, *(["--retry"] if chance.random() < 0.1 else [])), chance) and runs < 100:
        runs += 1
    print(f"{runs} disturbed runs, {len(files('out'))} files")
    tally = summary(*line, "--retry", code=6)
    print(tally)
    expect(tally["items"] == len(names) and tally["left"] == 0, tally)
    expect(tally["failed"] == len(hostile), f"{tally['failed']} failed, {len(hostile)} are hostile")
    journal = records()
    expect(len(journal) == len(names), "an item is not accounted for")
    failed = {output for output, record in journal.items() if record["status"] == "failed"}
    expect(failed == {f"out/{name}.json" for name in hostile}, "others failed than the hostile ones")
    good = [name for name in names if name not in hostile]
    check_outputs("out", [f"{name}.json" for name in good])
    for i, name in enumerate(names):
        if name not in hostile:
            expect(graph(f"out/{name}.json") == graphs[SMALL[i % len(SMALL)]], f"{name} is damaged")


CASES = {name[5:]: function for name, function in list(globals().items()) if name.startswith("case_")}

if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print("\n".join(CASES))
        sys.exit(0)
    PROGRAM, MODELS = map(os.path.realpath, sys.argv[1:3])
    for case in sys.argv[3:]:
        with tempfile.TemporaryDirectory() as scratch:
            os.chdir(scratch)
            CASES[case]()
            os.chdir("/")
