# SPDX-License-Identifier: BSD-3-Clause
"""The documents, their blocks of commands, and how a test runs those."""
import pathlib, re

COMMAND = re.compile(r'\s*(\./)?(hoctomap(-\w+)? |scripts/|cmake |ctest |cpack|apt |colcon |python3 |/usr/bin/python3 |build/|alias |[A-Z_]+=\S+ |rosbag2rawlog |snakemake )')

# Blocks marked `sh small` are experiments of minutes and hours. A test runs them with these changes.
SMALL = [
    (r'\b(hoctomap-experiments vi-a)\b', r'\1 --quick --repeats 1'),
    (r'\b(hoctomap-experiments vi-b)\b', r'\1 --quick --scans 12'),
    (r'\b(hoctomap-experiments vi-c)\b', r'\1 --quick --method recommended --views 2'),
    (r'\b(hoctomap-experiments changes)\b', r'\1 --quick'),
    (r'\b(hoctomap-experiments identity)\b', r'\1 --scenes 1 --views 2'),
    (r'--simulated \d+', '--simulated 1'),
    (r'--resolution 0\.005\b', '--resolution 0.05'),
    (r'\b(hoctomap explore)\b', r'\1 --set camera.width=160 --set camera.height=120 --set camera.fx=135 --set exploration.max_views=1'
                                r' --set exploration.first_look=2'),
]

# Blocks marked `sh elsewhere` hold what cannot run inside a test, and nothing but this.
ELSEWHERE = {
    r'(\./)?scripts/test\.sh.*': 'what CI runs',
    r'\./scripts/demo\.sh': 'installs packages; its commands are those of the README',
    r'alias hoctomap(-experiments)?=\$PWD/build/\w+/apps/.*': 'a test has its own',
    r'cmake --preset [\w-]+ && cmake --build --preset [\w-]+( --target [\w-]+)?( && ctest --preset [\w-]+)?': 'builds; scripts/test.sh does',
    r'cmake --install build/release --prefix \S+': 'tests/install installs',
    r'PYTHONPATH=build/dev/python /usr/bin/python3 -m pytest tests/python': 'ctest runs it',
    r'(\./)?scripts/(package_test|asan|tsan|coverage)\.sh( io)?': 'root, or half an hour',
    r'scripts/workflow_test\.sh': 'minutes; tests/workflows runs it with four logs',
    r'(scripts/slurm_here\.sh )?snakemake .*--profile workflows/profiles/slurm.*': 'scripts/workflow_test.sh does, with a Slurm of its own',
    r'snakemake -s workflows/Snakefile --directory dataset --cores 8': 'docs/tutorials/many_logs.md does',
    r'apt install \./build/release/packages/\S+ \./build/release/packages/\S+': 'scripts/package_test.sh does, in a clean root',
    r'scripts/benchmark\.sh( \[LOG\])?': 'half an hour; hoctomap-experiments performance --quick is tested',
    r'HOCTOMAP_BENCHMARK_LOG=\S+ build/benchmark/tests/benchmarks/hoctomap-benchmarks .*': 'part of scripts/benchmark.sh',
    r'scripts/insert_figures\.sh docs/performance\.md out/benchmark/performance\.md': 'after scripts/benchmark.sh',
}


def all_documents(sources):
    """Every page of the project."""
    folders = [sources / name for name in ('docs', 'libs', 'apps', 'tests', 'python', 'packaging', 'configs', 'workflows')]
    pages = [page for folder in folders for page in sorted(folder.rglob('*.md')) if 'node_modules' not in page.parts]
    return sorted(sources.glob('*.md')) + pages


def blocks(document):
    """(info string, number of the first line, lines) of every fenced block."""
    lines = document.read_text().splitlines()
    at = 0
    while at < len(lines):
        fence = re.match(r'(\s*)```(.*)', lines[at])
        if fence:
            end = next(i for i in range(at + 1, len(lines)) if lines[i].strip() == '```')
            yield fence[2].strip(), at + 2, lines[at + 1:end]
            at = end
        at += 1


def without_comment(line):
    return re.sub(r'\s+#.*', '', line).strip()


def small(line):
    for pattern, replacement in SMALL:
        line = re.sub(pattern, replacement, line)
    return line
