# SPDX-License-Identifier: BSD-3-Clause
"""Runs the workflow over logs, one of them damaged, and looks at what came out: the damaged one is named, the rest is mapped, a job that
is killed is run again, and maps are the same byte for byte, wherever the jobs ran.

Usage: run_workflow.py HOCTOMAP HELPER SOURCES [--logs N] [--shared FOLDER] [--slurm] [--speed] [--out FOLDER]
  --logs   how many, one of them damaged (4; more take in real data)     --slurm  also on Slurm, on this machine
  --speed  first on one core and on two, with times                      --out    where all stays (a temporary folder that does not)
Exit code 77: Snakemake (or Slurm) is not installed."""
import argparse, csv, os, pathlib, re, resource, shlex, shutil, signal, subprocess, sys, tempfile, time

parser = argparse.ArgumentParser()
parser.add_argument('programs', nargs=3, type=pathlib.Path)
parser.add_argument('--logs', type=int, default=4)
parser.add_argument('--shared', type=pathlib.Path)
parser.add_argument('--slurm', action='store_true')
parser.add_argument('--speed', action='store_true')
parser.add_argument('--out', type=pathlib.Path)
options = parser.parse_args()
PROGRAM, HELPER, SOURCES = (path.resolve() for path in options.programs)
if options.shared:
    options.shared = options.shared.resolve()
LONG, DAMAGED = 'desk-long', 'damaged'
KILLED_PART = f'{LONG}/parts/0'
PART_SCANS = 10
problems = []


def expect(holds, what):
    print(('ok      ' if holds else 'FAILED  ') + what, flush=True)
    if not holds:
        problems.append(what)


def need(*programs):
    for program in programs:
        if not shutil.which(program, path=os.environ['PATH'] + ':/usr/sbin:/sbin'):
            print(f'skipped: {program} is not installed (scripts/install_dependencies.sh --workflows)')
            sys.exit(77)


# ---- the logs ----

def simulate(log, scene, *settings):
    words = [word for setting in settings for word in ('--set', setting)]
    subprocess.run([PROGRAM, 'simulate', '-q', '-c', SOURCES / f'configs/scenes/{scene}.ini', '-o', log, *words], check=True,
                   stdout=subprocess.DEVNULL, env=ENVIRONMENT)


def real_logs(shared):
    """(name, log, place): what ../shared/data has, short logs first."""
    data = shared / 'data'
    found = [(path.parent.name, path, '') for path in sorted(data.glob('mosd_change/*/sequence.rawlog'))]
    found += [(f'tote-{path.stem}', path, 'tote') for path in sorted(data.glob('arc_tote/*.rawlog'))]
    found += [(path.stem, path, '') for path in sorted(data.glob('pr2_stereo/*.rawlog')) + sorted(data.glob('redkitchen/*.rawlog'))]
    found += [(path.name, path, '') for path in sorted(data.glob('tum_format/*')) if path.is_dir()]
    return found


def make_logs(folder):
    """A table of logs: a long one, visits of a desk whose tin goes from place to place, real ones, one that is cut off."""
    folder.mkdir(parents=True)
    rows = []

    def add(name, place='', log=None, config=''):
        rows.append((name, log or f'{name}.rawlog', '', config, place))
        return folder / f'{name}.rawlog'

    settings = (SOURCES / 'configs/tabletop.ini').read_text()
    (folder / 'often.ini').write_text(re.sub(r'(?m)^checkpoint_scans *=.*$', 'checkpoint_scans = 2', settings))
    simulate(add(LONG, 'desk', config='often.ini'), 'demo', 'simulation.seed=1', f'path.sweep.views={2 * PART_SCANS if options.logs == 4 else 12 * PART_SCANS}')
    real = real_logs(options.shared)[-(options.logs - 4) * 2 // 3:] if options.shared and options.logs > 4 else []
    for name, log, place in real:
        add(name, place, log)
    for k in range(options.logs - len(rows) - 1):
        if options.logs > 4 and k % 6 == 5:
            simulate(add(f'occlusion-{k}'), 'occlusion', f'simulation.seed={k}')
        else:
            simulate(add(f'desk-{k}', 'desk'), 'demo', f'simulation.seed={k + 2}', f'solid.tin.position=0.10 {0.22 - 0.05 * (k % 3)} 0')
    whole = (folder / 'desk-0.rawlog').read_bytes()
    add(DAMAGED, 'desk').write_bytes(whole[:len(whole) // 2])
    with open(folder / 'logs.csv', 'w', newline='') as file:
        csv.writer(file).writerows([('name', 'log', 'poses', 'config', 'place'), *rows])
    return [row[0] for row in rows]


# ---- runs ----

def data_set(name):
    """A folder with the same table, and links to the same logs."""
    folder = OUT / name
    folder.mkdir()
    for path in (OUT / 'logs').iterdir():
        (folder / path.name).symlink_to(path)
    return folder


def workflow(folder, *words):
    reports = 'true' if options.logs > 4 else 'false'
    return ['snakemake', '-s', SOURCES / 'workflows/Snakefile', '--directory', folder, *words,
            '--config', f'part_scans={PART_SCANS}', f'reports={reports}']


def run(folder, command, meanwhile=None):
    """(wall, CPU) seconds of a run that has to end well."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with open(folder / 'workflow.log', 'a') as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, env=ENVIRONMENT)
        if meanwhile:
            meanwhile(folder, process)
        process.wait()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    expect(process.returncode == 0, f'{folder.name}: the workflow ends with exit code 0')
    return time.monotonic() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def processes_of(*words):
    """Those of which a word of the command line is each of these."""
    for entry in pathlib.Path('/proc').glob('[0-9]*'):
        try:
            line = (entry / 'cmdline').read_bytes().decode(errors='replace').split('\0')
        except OSError:
            continue
        if all(word in line for word in words):
            yield int(entry.name)


def running_build(folder, workflow):
    """The process of one that is at work and has committed something, held in its tracks; None if the workflow ends before."""
    while workflow.poll() is None:
        if (folder / KILLED_PART / 'hierarchy.yaml').exists():
            for pid in processes_of(str(PROGRAM), 'build', KILLED_PART):
                if os.readlink(f'/proc/{pid}/cwd') == str(folder):
                    os.kill(pid, signal.SIGSTOP)
                    return pid
        time.sleep(0.01)
    return None


def kill_process(folder, workflow):
    pid = running_build(folder, workflow)
    expect(pid is not None, f'{folder.name}: a build is killed')
    if pid:
        os.kill(pid, signal.SIGKILL)


def cancel_job(folder, workflow):
    """The whole job of Slurm, with the Snakemake in it."""
    pid = running_build(folder, workflow)
    expect(pid is not None, f'{folder.name}: the job of a build is cancelled')
    if pid:
        words = pathlib.Path(f'/proc/{pid}/environ').read_bytes().decode(errors='replace').split('\0')
        job = dict(word.split('=', 1) for word in words if '=' in word)
        subprocess.run(['scancel', job['SLURM_JOB_ID']], check=True, env=job)


# ---- what came out ----

def map_files(folder, name):
    """What has to be the same from run to run."""
    map = (folder / name / 'map').resolve()  # that of the only part, perhaps
    return {path.relative_to(map): path.read_bytes() for path in sorted(map.rglob('*'))
            if path.is_file() and path.name not in ('timing.csv', 'log.txt') and 'lock' not in path.name}


def look_at(folder, names):
    with open(folder / 'summary.csv', newline='') as file:
        rows = {row['name']: row for row in csv.DictReader(file)}
    expect(list(rows) == names, f'{folder.name}: the summary has all {len(names)} logs')
    bad = rows[DAMAGED]
    expect(bad['status'] == 'failed' and bad['exit_code'] == '3' and 'cut' in bad['error'], f'{folder.name}: the damaged log is named: {bad["error"]}')
    others = [row for row in rows.values() if row['name'] != DAMAGED]
    mapped = sum(row['status'] == 'ok' for row in others)
    expect(mapped == len(others), f'{folder.name}: {mapped} of {len(others)} others are mapped')
    expect(int(rows[LONG]['parts']) > 1, f'{folder.name}: the long log was mapped in {rows[LONG]["parts"]} parts')
    expect(rows[LONG]['objects'] == '3', f'{folder.name}: its three objects are in the merged map')
    moved = [row for row in others if row['since'].startswith('desk') and row['name'].startswith('desk') and row['since'] != LONG]
    expect(any(int(row['moved']) > 0 for row in moved), f'{folder.name}: the tin was moved between visits')
    expect((folder / 'summary.html').read_text().count('<tr') == len(names) + 1, f'{folder.name}: the page has a line for each')


def look_at_retry(folder):
    expect('Trying to restart job' in (folder / 'workflow.log').read_text(), f'{folder.name}: the killed job was run again')
    log = folder / KILLED_PART / 'log.txt'
    expect(log.exists() and 'continuing at scan' in log.read_text(), f'{folder.name}: it went on where it was killed')


def compare(a, b, names):
    for name in names:
        if name != DAMAGED and map_files(a, name) != map_files(b, name):
            return expect(False, f'{name}: the maps of {a.name} and {b.name} are the same')
    files = sum(len(map_files(a, name)) for name in names if name != DAMAGED)
    expect(files > 0, f'{a.name} and {b.name}: {files} files of maps are the same')
    expect((a / 'summary.csv').read_bytes() == (b / 'summary.csv').read_bytes(), f'{a.name} and {b.name}: the summaries are the same')


def told(what, wall, cpu):
    print(f'{what:9} {wall:.1f} s wall, {cpu:.1f} s CPU ({100 * cpu / wall:.0f} %), load of the machine {os.getloadavg()[0]:.1f}', flush=True)


def main():
    names = make_logs(OUT / 'logs')
    if options.speed:
        one = data_set('one-core')
        wall_1, cpu_1 = run(one, ['taskset', '-c', '0', *workflow(one, '--cores', '1')])
        told('one core', wall_1, cpu_1)
    local = data_set('local')
    wall_2, cpu_2 = run(local, workflow(local, '--cores', '2'), kill_process)
    told('two cores', wall_2, cpu_2)
    look_at_retry(local)
    look_at(local, names)
    if options.speed:
        print(f'speed-up  {wall_1 / wall_2:.2f}', flush=True)
        compare(one, local, names)
    again = subprocess.run(workflow(local, '--cores', '2'), capture_output=True, text=True, env=ENVIRONMENT)
    expect('Nothing to be done' in again.stderr, 'local: a second run has nothing to do')
    if options.slurm:
        slurm = data_set('slurm')
        ENVIRONMENT['CI'] = 'true'  # Snakemake then asks for the state of jobs every second, not every ten
        command = [SOURCES / 'scripts/slurm_here.sh', '--cpus', '2', *workflow(slurm, '--profile', SOURCES / 'workflows/profiles/slurm')]
        told('slurm', *run(slurm, command, cancel_job))
        look_at_retry(slurm)
        look_at(slurm, names)
        compare(local, slurm, names)


need('snakemake', *(['sbatch', 'munged', 'slurmctld', 'slurmd'] if options.slurm else []))
OUT = (options.out or pathlib.Path(tempfile.mkdtemp())).resolve()
OUT.mkdir(parents=True, exist_ok=True)
commands = OUT / 'bin'
commands.mkdir()
(commands / 'hoctomap').write_text(f'#!/bin/sh\nHOCTOMAP_MRPT={shlex.quote(str(HELPER))} exec {shlex.quote(str(PROGRAM))} "$@"\n')
(commands / 'hoctomap').chmod(0o755)
ENVIRONMENT = dict(os.environ, PATH=f'{commands}:{os.environ["PATH"]}:/usr/sbin:/sbin', HOCTOMAP_MRPT=str(HELPER), XDG_CACHE_HOME=str(OUT / 'cache'))
try:
    main()
finally:
    if not options.out:
        shutil.rmtree(OUT)
sys.exit(1 if problems else 0)
