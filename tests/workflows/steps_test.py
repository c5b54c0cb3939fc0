# SPDX-License-Identifier: BSD-3-Clause
"""How a step ends, and what a table of logs may hold. Usage: steps_test.py SOURCES"""
import json, pathlib, subprocess, sys, tempfile, unittest

SCRIPTS = pathlib.Path(sys.argv.pop(1)).resolve() / 'workflows/scripts'
sys.path.insert(0, str(SCRIPTS))
import log_table


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Steps(Folder):
    def step(self, name, script, *options):
        """The exit code of run.py, and the outcome if there is one."""
        file = self.folder / f'{name}.json'
        code = subprocess.run([sys.executable, SCRIPTS / 'run.py', file, *options, '--', 'sh', '-c', script, 'sh'], cwd=self.folder, stderr=subprocess.DEVNULL).returncode
        return code, json.loads(file.read_text()) if file.exists() else None

    def test_what_is_wrong_with_a_log_is_a_result(self):
        for expected in (2, 3, 4, 6):
            code, outcome = self.step('build', f'echo other >&2; echo "hoctomap: a.rawlog: cut" >&2; exit {expected}')
            self.assertEqual((code, outcome['exit_code'], outcome['error']), (0, expected, 'a.rawlog: cut'))

    def test_anything_else_fails_the_job_and_leaves_no_outcome(self):
        for script, expected in (('exit 1', 1), ('exit 5', 5), ('exit 143', 143), ('kill -9 $$', 137)):
            self.assertEqual(self.step('build', script), (expected, None))

    def test_steps_after_a_failed_one_are_not_run_and_end_as_it_did(self):
        self.step('good', 'true')
        self.step('bad', 'exit 3')
        code, outcome = self.step('next', 'touch ran', '--after', 'good.json', 'bad.json')
        self.assertEqual((code, outcome['step'], outcome['exit_code'], outcome['ran']), (0, 'bad', 3, False))
        self.assertFalse((self.folder / 'ran').exists())

    def test_a_map_is_continued_or_made_anew_if_it_is_of_something_else(self):
        def build(script):
            _, outcome = self.step('build', f'echo $1 >> words; {script}', '--continue-in', 'map')
            words = (self.folder / 'words').read_text().split()
            (self.folder / 'words').unlink()
            return words, outcome['exit_code']

        self.assertEqual(build('true'), (['--overwrite'], 0))
        (self.folder / 'map').mkdir()
        (self.folder / 'map/hierarchy.yaml').touch()
        self.assertEqual(build('true'), (['--continue'], 0))
        self.assertEqual(build('[ $1 = --overwrite ] || exit 2'), (['--continue', '--overwrite'], 0))
        self.assertEqual(build('exit 3'), (['--continue', '--overwrite'], 3))
        self.assertEqual(build('exit 4'), (['--continue'], 4))

    def test_results_are_kept(self):
        _, outcome = self.step('verify', """echo '{"whole": true}'""", '--result')
        self.assertEqual(outcome['result'], {'whole': True})


class Tables(Folder):
    def read(self, *lines):
        table = self.folder / 'logs.csv'
        table.write_text('\n'.join(lines) + '\n')
        return log_table.read(table)

    def test_visits_of_a_place_follow_one_another(self):
        visits = self.read('name,log,poses,config,place', 'a,a.rawlog,,,hall', 'b,b.rawlog,odometry,my.ini,', 'c,c.rawlog,p.txt,,hall', 'd,d.rawlog,,,hall')
        self.assertEqual(log_table.previous_visits(visits), {'c': 'a', 'd': 'c'})
        self.assertEqual(visits['b'].build_options(), ['-q', '-i', 'b.rawlog', '--poses', 'odometry', '-c', 'my.ini'])
        self.assertEqual((visits['b'].pose_file, visits['c'].pose_file), ('', 'p.txt'))

    def test_folders_are_imported(self):
        visits = self.read('name,log,poses,config,place,import', f'a,{self.folder},p.txt,,,', f'b,{self.folder},,,,frames --level')
        self.assertEqual(visits['a'].import_command(), ['import', 'tum', str(self.folder), '--poses', 'p.txt', '-q', '-o', 'a/log.rawlog'])
        self.assertEqual(visits['a'].build_options(), ['-q', '-i', 'a/log.rawlog'])
        self.assertEqual(visits['b'].import_command()[:4], ['import', 'frames', str(self.folder), '--level'])

    def test_wrong_tables_are_refused_with_their_line(self):
        head = 'name,log,poses,config,place'
        for lines, why in ((['name,log'], 'line 1: no column poses'), ([head + ',colour'], "line 1: what is 'colour'"), ([head, '../a,x,,,'], 'line 2: name'),
                           ([head, 'a,x,,,', 'a,y,,,'], 'line 3: .a. is there twice'), ([head, 'a,,,,'], 'line 2: no log')):
            with self.assertRaisesRegex(ValueError, why):
                self.read(*lines)


unittest.main()
