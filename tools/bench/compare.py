"""compare.py ROOT [--quick] [--rounds N] [--json FILE] [--plot FILE.png] [MODEL...]: see tools/bench/run."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

STAGES = ["prepare", "hierarchy", "backend", "seeds", "settle", "handles", "connect", "refine", "check"]


def programs(build):
    """What is run on every model: a name, and the words before and after the model's own."""
    zskel, cgal = build / "tools/zskel", build / "tools/bench/zskel_bench_cgal"
    return {
        "zskel": (zskel, ["--backend", "cpu"]),
        "zskel, rays": (zskel, ["--backend", "ray"]),
        "CGAL": (cgal, []),
        "CGAL 1 2": (cgal, ["1", "2"]),
    }


def faces_of(model):
    with open(model) as file:
        return sum(line.startswith("f ") for line in file)


def run_once(program, model, output):
    """One whole process: seconds on the clock, CPU seconds, peak memory in MB; None when it fails."""
    path, options = program
    start = time.perf_counter()
    process = subprocess.Popen([path, "-q", "extract", model, "-o", output, *options], stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        return None
    return {"wall_s": wall, "cpu_s": usage.ru_utime + usage.ru_stime, "peak_mb": usage.ru_maxrss / 1024}


def medians(rows):
    return {key: statistics.median(row[key] for row in rows) for key in rows[0]}


def quality(build, folder, model):
    """The scorer's row for the skeleton of `model` in `folder`."""
    out = folder / "score.json"
    done = subprocess.run(
        [build / "tools/scoring/zskel_score", "--skeletons", folder, model, "--json", out], capture_output=True
    )
    return json.loads(out.read_text())["models"][0] if done.returncode == 0 else None


def measure_model(build, model, rounds, scratch):
    """Rounds over all programs, every other one in reverse, so that none always runs warm."""
    all_programs = programs(build)
    runs = {name: [] for name in all_programs}
    stages = []
    for index in range(rounds):
        for name in list(all_programs) if index % 2 == 0 else reversed(list(all_programs)):
            folder = scratch / name
            folder.mkdir(exist_ok=True)
            output = folder / f"{model.stem}.json"
            row = run_once(all_programs[name], model, output)
            if row is None:
                continue
            runs[name].append(row)
            if name == "zskel":
                stages.append(json.loads(output.read_text())["statistics"]["seconds"])
    found = {"model": str(model), "faces": faces_of(model), "programs": {}, "stages_s": medians(stages)}
    for name, rows in runs.items():
        entry = medians(rows) if rows else None
        if entry:
            entry["quality"] = quality(build, scratch / name, model)
        found["programs"][name] = entry
    return found


def print_processes(results):
    print("Whole processes, medians; ratio: its seconds over zskel's\n")
    head = f"{'model':<22} {'faces':>7}  {'program':<12} {'s':>8} {'ratio':>6} {'cpu s':>8} {'MB':>6} {'B/face':>6} {'evals':>6}"
    print(head + f"  {'topology':<8} {'inside':>6} {'off':>6} {'off 90':>6} {'cover':>6} {'turn':>5} {'ends':>4} {'spurs':>5}")
    for result in results:
        ours = result["programs"]["zskel"]
        for name, row in result["programs"].items():
            start = f"{'/'.join(pathlib.Path(result['model']).parts[-2:]):<22} {result['faces']:>7}  {name:<12}"
            if row is None:
                print(start, "failed")
                continue
            line = f"{start} {row['wall_s']:>8.3f} {row['wall_s'] / ours['wall_s']:>6.2f} {row['cpu_s']:>8.3f}"
            line += f" {row['peak_mb']:>6.0f} {row['peak_mb'] * 2**20 / result['faces']:>6.0f}"
            q = row["quality"]
            if q is None or q["failure"]:
                print(line, " no score")
                continue
            evaluations = f"{q['evaluations']:.0f}" if q.get("evaluations") else ""
            print(
                line,
                f"{evaluations:>6}  {'wrong' if q['topology_wrong'] else 'right':<8} {q['inside']:>6.3f}"
                f" {q['off_centre_median']:>6.3f} {q['off_centre_p90']:>6.3f} {q['cover_p95']:>6.2f}"
                f" {q['turn_deg']:>5.1f} {q['ends']:>4.0f} {q['spurs']:>5.0f}",
            )


def print_stages(results):
    print("\nStages of zskel, ms\n")
    print(f"{'model':<22} {'faces':>7} " + " ".join(f"{s:>8}" for s in STAGES))
    for result in results:
        name = "/".join(pathlib.Path(result["model"]).parts[-2:])
        times = " ".join(f"{result['stages_s'].get(s, 0) * 1e3:>8.1f}" for s in STAGES)
        print(f"{name:<22} {result['faces']:>7} {times}")


def measure_sources(build, models, quick):
    out = subprocess.run(
        [
            build / "tools/bench/zskel_bench_sources",
            "--benchmark_format=json",
            f"--benchmark_min_time={0.02 if quick else 0.5}",
            *models,
        ],
        check=True,
        stdout=subprocess.PIPE,
    )
    found = json.loads(out.stdout)
    said = {int(k.rsplit("_", 1)[1]): int(v) for k, v in found["context"].items() if k.startswith("gpu_from_")}
    crossover = dict(sorted(said.items()))
    rows = []
    for run in found["benchmarks"]:
        source, face_px, subject = run["name"].split("/")[:3]
        name, faces = subject.split(":")
        us = None if run.get("error_occurred") else run["us_per_eye"]
        rows.append({"source": source, "face_px": int(face_px), "model": name, "faces": int(faces), "us": us})
    return rows, crossover


def print_sources(rows):
    print("\nOne eye's record (cube map, force, Jacobian, nearest distance, shares), microseconds, one thread\n")
    columns = list(dict.fromkeys((r["source"], r["face_px"]) for r in rows))
    names = [source if px == 0 else f"{source} {px}" for source, px in columns]
    print(f"{'model':<16} {'faces':>7} " + " ".join(f"{n:>8}" for n in names))
    for model, faces in dict.fromkeys((r["model"], r["faces"]) for r in rows):
        of = {(r["source"], r["face_px"]): r["us"] for r in rows if (r["model"], r["faces"]) == (model, faces)}
        print(
            f"{model:<16} {faces:>7} "
            + " ".join(f"{of[c]:>8.1f}" if of.get(c) is not None else f"{'-':>8}" for c in columns)
        )


def print_crossover(crossover):
    print("\nEvaluations (16 texels a face) from which `auto` takes a GPU, by prediction, on this machine's threads\n")
    print("faces       " + " ".join(f"{faces:>9}" for faces in crossover))
    print("evaluations " + " ".join(f"{count:>9}" for count in crossover.values()))


def plot(results, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 5), dpi=150)
    for name in results[0]["programs"]:
        points = sorted((r["faces"], r["programs"][name]["wall_s"]) for r in results if r["programs"][name])
        axes.loglog(*zip(*points), "o", label=name, markersize=4)
    axes.set_xlabel("faces")
    axes.set_ylabel("seconds, whole process")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(prog="tools/bench/run", description="Times zskel beside its peers")
    parser.add_argument("root", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("models", nargs="*", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="two models, one round")
    parser.add_argument("--rounds", type=int, default=0, help="of every program on every model (5; quick: 1)")
    parser.add_argument("--json", type=pathlib.Path, help="write every number")
    parser.add_argument("--plot", type=pathlib.Path, help="write seconds by faces as a PNG")
    arguments = parser.parse_intermixed_args()
    build = arguments.root / "build/release"
    names = ["horse", "octopus"] if arguments.quick else ["horse", "octopus", "hand", "double_torus", "horse_8k", "plant"]
    models = arguments.models or [arguments.root / "models" / f"{name}.obj" for name in names]
    for model in models:
        if not model.is_file():
            sys.exit(f"tools/bench/run: {model}: no such model")
    rounds = arguments.rounds or (1 if arguments.quick else 5)
    with tempfile.TemporaryDirectory() as scratch:
        results = []
        for index, model in enumerate(models):
            folder = pathlib.Path(scratch) / str(index)
            folder.mkdir()
            results.append(measure_model(build, model, rounds, folder))
    print_processes(results)
    print_stages(results)
    sources, crossover = measure_sources(build, models, arguments.quick)
    print_sources(sources)
    print_crossover(crossover)
    if arguments.json:
        arguments.json.write_text(json.dumps({"processes": results, "sources": sources}, indent=1))
    if arguments.plot:
        plot(results, arguments.plot)


main()
