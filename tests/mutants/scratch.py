"""A copy of the tree with a build of its own, in which mutants are made and run."""

import fcntl
import json
import os
import resource
import shlex
import signal
import subprocess
import time
from pathlib import Path

from records import Bad

MEMORY = 4 << 30  # bytes of address space of one test: a mutant must not eat the machine
FILE = 1 << 30  # bytes of one file that it writes
# arguments which another order turns into nonsense do not compile
FLAGS = '-Werror=incompatible-pointer-types -Werror=int-conversion'


def tracked(source):
    """Files of the tree as it stands, without what git ignores; all files where there is no git."""
    if (source / '.git').exists():
        names = subprocess.run(
            ['git', '-C', source, 'ls-files', '-z', '-co', '--exclude-standard'], capture_output=True, check=True
        ).stdout.decode()
        return [n for n in names.split('\0') if n and (source / n).is_file()]
    return [str(p.relative_to(source)) for p in source.rglob('*') if p.is_file()]


class Scratch:
    def __init__(self, source, place, options):
        self.source, self.place = Path(source).resolve(), Path(place).resolve()
        if self.place == self.source or self.source in self.place.parents:
            raise Bad(f'{place}: the scratch copy must lie outside of the tree {source}')
        self.tree, self.build, self.tmp = self.place / 'tree', self.place / 'build', self.place / 'tmp'
        for folder in (self.tree, self.tmp):
            folder.mkdir(parents=True, exist_ok=True)
        self.lock = open(self.place / 'lock', 'w')
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise Bad(f'{place}: another campaign works there; give --scratch another folder') from None
        self._copy()
        self._setup(options)
        self.tests = self._introspect('--tests')
        self.targets = self._introspect('--targets')
        self._objects()

    def _copy(self):
        """Touches only files that differ, so that only these are built again."""
        names = tracked(self.source)
        for name in names:
            data, there = (self.source / name).read_bytes(), self.tree / name
            if not there.is_file() or there.read_bytes() != data:
                there.parent.mkdir(parents=True, exist_ok=True)
                there.write_bytes(data)
                there.chmod((self.source / name).stat().st_mode)
        for old in set(tracked(self.tree)) - set(names):
            (self.tree / old).unlink()

    def _setup(self, options):
        command = ['meson', 'setup', f'-Dc_args={FLAGS}', *options, self.build, self.tree]
        if (self.build / 'build.ninja').exists():
            return
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            raise Bad(f'meson setup failed:\n{done.stdout}')

    def _introspect(self, what):
        self.ninja('build.ninja')
        out = subprocess.run(['meson', 'introspect', self.build, what], capture_output=True, text=True, check=True)
        return json.loads(out.stdout)

    def _objects(self):
        """Objects that are made of each source file."""
        self.objects = {}
        for entry in json.load(open(self.build / 'compile_commands.json')):
            path = (Path(entry['directory']) / entry['file']).resolve()
            if self.tree in path.parents:
                self.objects.setdefault(str(path.relative_to(self.tree)), []).append(entry['output'])

    def ninja(self, *targets):
        """Builds; whether it went well, and what was said."""
        done = subprocess.run(
            ['ninja', '-C', self.build, *targets], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        return done.returncode == 0, done.stdout

    def needed(self, tests):
        """What these tests run on: their own targets and all that is installed."""
        wanted = {d for t in tests for d in t['depends']}
        names = []
        for target in self.targets:
            if target['id'] in wanted or target['installed'] and target['type'] != 'custom':
                names += [os.path.relpath(f, self.build) for f in target['filename']]
        return sorted(set(names))

    def compiled(self, file):
        """The bytes of all objects of a file."""
        return [(self.build / o).read_bytes() for o in self.objects.get(file, []) if (self.build / o).exists()]

    def run(self, command, environment, folder, cpu, wall, log):
        """Runs a command: its exit code (None: over its time), its CPU seconds."""

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (int(cpu) + 1, int(cpu) + 2))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_FSIZE, (FILE, FILE))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with open(log, 'wb') as out:
            child = subprocess.Popen(
                command, cwd=folder or self.build, env={**os.environ, 'TMPDIR': str(self.tmp), **environment},
                stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, preexec_fn=limit,
                start_new_session=True,
            )
            end, late = time.monotonic() + wall, False
            try:
                while True:
                    pid, status, used = os.wait4(child.pid, os.WNOHANG)
                    if pid:
                        break
                    if time.monotonic() > end and not late:
                        late = True
                        os.killpg(child.pid, signal.SIGKILL)
                    time.sleep(0.01)
            except BaseException:
                os.killpg(child.pid, signal.SIGKILL)
                raise
            child.returncode = 0  # it was waited for
        seconds = used.ru_utime + used.ru_stime
        code = os.waitstatus_to_exitcode(status)
        over = (-signal.SIGXCPU, 128 + signal.SIGXCPU)  # the command itself; what a shell has run for it
        return (None if late or code in over else code), seconds


def shell(text):
    return ['sh', '-c', text] if any(c in text for c in '|&;<>$`(){}*?"\'\n') else shlex.split(text)
