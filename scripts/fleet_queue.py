#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A fleet's logs in the queue of a cluster: when is a map ready? Seeded, some seconds. docs/scaling.md says where the figures come from.

Each robot hands in one log a day, most of them in the evening. A log is cut into parts that are jobs of one core and some memory;
the first part to come is the first to start (as Slurm's queue does where all have the same priority). Some jobs are killed
and run again from their last commit. When the parts are done, the map is merged.

Usage: fleet_queue.py [--robots 10000] [--days 3] [--seed 1] [--cores 100,120,160] [-o FOLDER]     writes fleet.csv, fleet.png"""
import argparse, csv, heapq, pathlib
import numpy as np

SCANS = 3600             # a log: an hour, a scan a second
SECONDS_A_SCAN = 0.16    # CPU of a build on one core, 300,000 points a scan
SPREAD = 0.35            # of it from log to log (log-normal)
ESTIMATE_SECONDS = 45    # passes over the log and a sample
OTHER_SECONDS = 15       # merge, verify, changes, report, and what the workflow engine takes for its jobs
PART_SCANS = 2000
KILLED = 0.01            # of the jobs, at a random moment; a commit is 10 scans old at most
HOUR = 3600.0


def arrivals(random, robots, days):
    """Times in seconds: robots come home around 18 h, one in three around noon."""
    hour = np.where(random.random((days, robots)) < 1 / 3, random.normal(12.5, 1.0, (days, robots)), random.normal(18.0, 1.5, (days, robots)))
    return np.sort(((np.clip(hour, 0, 24) + 24 * np.arange(days)[:, None]) * HOUR).ravel())


class Cluster:
    """Cores that take jobs in the order in which they come."""

    def __init__(self, cores):
        self.free_at = [0.0] * cores
        self.busy = 0.0

    def run(self, ready, seconds):
        start = max(ready, heapq.heappop(self.free_at))
        heapq.heappush(self.free_at, start + seconds)
        self.busy += seconds
        return start + seconds


def simulate(seed, robots, days, cores):
    """Seconds from handing in a log to its map, and the share of the cores' time that is used."""
    random = np.random.default_rng(seed)
    cluster = Cluster(cores)
    parts = -(-SCANS // PART_SCANS)
    come = arrivals(random, robots, days)
    per_scan = SECONDS_A_SCAN * np.exp(random.normal(-SPREAD**2 / 2, SPREAD, len(come)))
    events = [(at, log, 'estimate') for log, at in enumerate(come)]
    heapq.heapify(events)
    open_parts, done, ready = np.full(len(come), parts), np.zeros(len(come)), np.zeros(len(come))
    while events:
        at, log, step = heapq.heappop(events)
        if step == 'estimate':
            end = cluster.run(at, ESTIMATE_SECONDS)
            for _ in range(parts):
                heapq.heappush(events, (end, log, 'part'))
        elif step == 'part':
            seconds = per_scan[log] * SCANS / parts
            if random.random() < KILLED:  # runs again what the last commit did not hold
                seconds += 10 * per_scan[log] + ESTIMATE_SECONDS / 3
            ready[log] = max(ready[log], cluster.run(at, seconds))
            open_parts[log] -= 1
            if open_parts[log] == 0:
                heapq.heappush(events, (ready[log], log, 'finish'))
        else:
            done[log] = cluster.run(at, OTHER_SECONDS)
    return done - come, cluster.busy / (cores * days * 24 * HOUR)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--robots', type=int, default=10_000)
    parser.add_argument('--days', type=int, default=3)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--cores', default='80,90,100,120,160,240,400,700')
    parser.add_argument('-o', '--output', type=pathlib.Path, default=pathlib.Path('out/fleet'))
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for cores in map(int, options.cores.split(',')):
        waited, used = simulate(options.seed, options.robots, options.days, cores)
        last_day = waited[-options.robots:] / HOUR
        rows.append((cores, round(used, 3), *np.round(np.quantile(last_day, [0.5, 0.95, 1.0]), 2)))
        print('cores {:5d}   used {:.0%}   map ready after: median {:.2f} h, 95 % {:.2f} h, last {:.2f} h'.format(rows[-1][0], *rows[-1][1:]), flush=True)
    with open(options.output / 'fleet.csv', 'w', newline='') as file:
        csv.writer(file, lineterminator='\n').writerows([('cores', 'used', 'median_h', 'p95_h', 'last_h'), *rows])
    plot(rows, options)


def plot(rows, options):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    cores, _, median, p95, last = zip(*rows)
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    for values, name in ((last, 'last'), (p95, '95 %'), (median, 'median')):
        axes.plot(cores, values, 'o-', label=name)
    axes.set(xscale='log', yscale='log', xlabel='cores', ylabel='hours from log to map', title=f'{options.robots} robots, an hour a day each')
    axes.set_xticks(cores, cores)
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(options.output / 'fleet.png', dpi=110)


main()
