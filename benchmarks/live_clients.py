"""Whether pages that watch a run delay its control loop: the tick's time without pages and with many.

    python benchmarks/live_clients.py [--clients 50] [--rounds 5] [--duration 20] [--pin]

Runs a walk at real time, in pairs with nobody who watches and with many pages, of which one never reads; which comes first
takes turns. Prints quantiles of the controller's tick [µs], their ratio pair by pair, and exits with 1 where the median pair's
99.9 % is over 5 % longer.

What is timed is the controller's tick by the clock on the wall, so whatever takes its core is in it. Without `--pin` that are the
pages as well, which run on the same machine. With it they have cores of their own, in both members of a pair alike: the program,
with its server's and log's threads, has the first core alone (or the first `--cores`), the pages the others. Then a pair's
difference is what the server costs the loop, on the same core, and not what the pages cost. A round of 20 s has 8 ticks beyond its 99.9 %: where the pairs differ by more than the
median, the machine is not quiet enough to say. That handing a tick over neither allocates nor locks is a test
(tests/app/live_feed_test.cpp).
"""

import argparse
import contextlib
import json
import multiprocessing
import os
import pathlib
import statistics
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/python"))

from live_page import Served  # noqa: E402
from mcap.reader import make_reader  # noqa: E402


def read_until_closed(page, blocks):
    try:
        while True:
            page.hear()
            with blocks.get_lock():
                blocks.value += len(page.blocks)
            page.blocks.clear()
            page.texts.clear()
    except OSError:
        pass


def watch(served, clients, blocks, cores):
    """As many pages, in a process that gives way to the run as a browser on another machine would."""
    os.nice(15)
    os.sched_setaffinity(0, cores)
    pages = [served.page() for _ in range(clients)]
    for page in pages[1:]:
        threading.Thread(target=read_until_closed, args=(page, blocks), daemon=True).start()
    threading.Event().wait()


def check_watched(served, clients, blocks):
    """All of them are there, and those that read get blocks."""
    with served.page() as page:
        page.status(lambda status: status["clients"] == clients + 1, seconds=30)
    before = blocks.value
    time.sleep(2.0)
    if clients > 1 and blocks.value - before < 10 * (clients - 1):
        sys.exit(f"{clients} pages got {blocks.value - before} blocks in 2 s; they don't watch")


@contextlib.contextmanager
def on(cores):
    """What is started meanwhile runs on these cores alone."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, cores)
    yield
    os.sched_setaffinity(0, before)


def run(clients, duration, program_cores, page_cores):
    """Times of the ticks [µs]."""
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder) / "run.mcap"
        with on(program_cores):
            served = Served("run", "walk_flat", "--view", "--view-clients", 64, "--set", f"duration={duration}", "--record", log)
        with served:
            context = multiprocessing.get_context("fork")
            blocks = context.Value("q", 0)
            watching = context.Process(target=watch, args=(served, clients, blocks, page_cores), daemon=True)
            watching.start()
            check_watched(served, clients, blocks)
            while not log.exists():
                threading.Event().wait(0.2)
            served.end()
            watching.kill()
        with log.open("rb") as file:
            return [json.loads(message.data)["total"] for *_, message in make_reader(file).iter_messages(topics=["/timings"])]


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--clients", type=int, default=50)
parser.add_argument("--rounds", type=int, default=5)
parser.add_argument("--duration", type=float, default=20.0)
parser.add_argument("--pin", action="store_true", help="program and pages on different cores, in both members of a pair")
parser.add_argument("--cores", type=int, default=1, help="with --pin: cores of the program")
arguments = parser.parse_args()
cores = sorted(os.sched_getaffinity(0))
program_cores, page_cores = set(cores), set(cores)
if arguments.pin:
    program_cores, page_cores = set(cores[: arguments.cores]), set(cores[arguments.cores :])
    if not program_cores or not page_cores:
        parser.error(f"--pin with --cores {arguments.cores} of {len(cores)} leaves none for the pages; valid is 1 to {len(cores) - 1}")
    os.sched_setaffinity(0, page_cores)  # this process reads what the program says, as the pages do
shares = [0.5, 0.99, 0.999]
if arguments.pin:
    print(f"the program on cores {sorted(program_cores)}, the pages on {sorted(page_cores)}", flush=True)
print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before the first round", flush=True)
pairs = []
for i in range(arguments.rounds):
    pair = {}
    for clients in (0, arguments.clients) if i % 2 == 0 else (arguments.clients, 0):
        ticks = run(clients, arguments.duration, program_cores, page_cores)
        pair[clients] = [quantile(ticks, share) for share in shares]
        texts = (f"p{100 * share:g} {value:.1f} µs" for share, value in zip(shares, pair[clients]))
        print(f"{clients} pages, {len(ticks)} ticks:", *texts, flush=True)
    pairs.append(pair)
for i, share in enumerate(shares):
    alone, watched = (statistics.median(pair[clients][i] for pair in pairs) for clients in (0, arguments.clients))
    ratios = sorted(pair[arguments.clients][i] / pair[0][i] for pair in pairs)
    middle = statistics.median(ratios)
    print(f"p{100 * share:g}: {alone:.1f} µs alone, {watched:.1f} µs with {arguments.clients} pages; of the pairs "
          f"{100 * (middle - 1):+.1f} % ({100 * (ratios[0] - 1):+.1f} to {100 * (ratios[-1] - 1):+.1f} %)")  # fmt: skip
sys.exit(middle > 1.05)
