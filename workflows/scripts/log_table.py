# SPDX-License-Identifier: BSD-3-Clause
"""The table of logs: a CSV file with the columns name, log, poses, config, place, and perhaps import."""
import csv, dataclasses, math, pathlib, re, shlex

REQUIRED = ['name', 'log', 'poses', 'config', 'place']
OWN_POSES = ('', 'identity', 'odometry')


@dataclasses.dataclass(frozen=True)
class Visit:
    name: str    # of the folder of its results
    log: str     # a rawlog, a simplemap, or a folder of another format
    poses: str   # as --poses of `hoctomap build`; of a folder: as --poses of `hoctomap import`
    config: str  # INI file; empty: the built-in tabletop.ini
    place: str   # visits of one place are compared, in the order of the table
    format: str  # of a folder: `tum`, or what stands in the column `import`, perhaps with options; else empty

    @property
    def pose_file(self):
        return '' if self.poses in OWN_POSES else self.poses

    @property
    def log_to_build(self):
        return f'{self.name}/log.rawlog' if self.format else self.log

    def import_command(self):
        format, *options = shlex.split(self.format)
        poses = ['--poses', self.poses] if self.poses else []
        return ['import', format, self.log, *options, *poses, '-q', '-o', self.log_to_build]

    def build_options(self):
        """What `hoctomap build` wants for this log, whatever part of it."""
        poses = ['--poses', self.poses] if self.poses and not self.format else []
        return ['-q', '-i', self.log_to_build, *poses, *(['-c', self.config] if self.config else [])]


def read(path):
    """The visits by name, in the order of the table."""
    visits = {}
    with open(path, newline='', encoding='utf-8') as file:
        rows = csv.DictReader(file)
        columns = [column.strip() for column in rows.fieldnames or []]
        rows.fieldnames = columns
        missing = [column for column in REQUIRED if column not in columns]
        unknown = [column for column in columns if column not in REQUIRED + ['import']]
        if missing or unknown:
            raise ValueError(f'{path}: line 1: ' + ', '.join([f'no column {c}' for c in missing] + [f'what is {c!r}?' for c in unknown]))
        for row in rows:
            value = {column: (row[column] or '').strip() for column in columns}
            where = f'{path}: line {rows.line_num}: '
            if not re.fullmatch(r'[A-Za-z0-9][A-Za-z0-9._-]*', value['name']):
                raise ValueError(f'{where}name {value["name"]!r}: letters, digits, and ._- behind the first')
            if value['name'] in visits:
                raise ValueError(f'{where}{value["name"]!r} is there twice')
            if not value['log']:
                raise ValueError(f'{where}no log')
            folder = pathlib.Path(value['log']).is_dir()
            format = value.get('import') or ('tum' if folder else '')
            visits[value['name']] = Visit(*(value[column] for column in REQUIRED), format)
    return visits


def previous_visits(visits):
    """The visit before, of the same place, by name; the first visits of their places are not in it."""
    previous, last = {}, {}
    for visit in visits.values():
        if visit.place:
            if visit.place in last:
                previous[visit.name] = last[visit.place]
            last[visit.place] = visit.name
    return previous


def part_count(estimate, part_scans):
    """Of a log with this estimate (None where it could not be read): how many parts of at most part_scans scans it is mapped in."""
    return max(1, math.ceil(estimate['scans'] / int(part_scans))) if estimate else 1
