"""Records what a build does: numbers to the bit, what commands say and write, pages."""

import hashlib
import json
import os
import re
import shlex
import shutil
import struct
import subprocess
import sys
from math import prod
from pathlib import Path

import scenes

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'core/program'))
import records  # pylint: disable=wrong-import-position

HERE = Path(__file__).resolve().parent
PATIENCE = 600  # s of the clock for one command


class Bad(Exception):
    """A message for whoever started the tool."""


def flags(sets):
    return [word for text in sets for word in ('--set', text)]


def digest(data):
    return hashlib.sha256(data).hexdigest()


def exact(value):
    return value.hex() if isinstance(value, float) else str(value)


class Take:
    """Runs the program of a build in a folder of its own, beside copies of the example files."""

    def __init__(self, build, out, source):
        self.build, self.out, self.source = (Path(path).resolve() for path in (build, out, source))
        self.lab, self.work = Path(f'{self.out}.lab'), Path(f'{self.out}.lab/work')
        if not (self.build / 'flankfilm').is_file():
            raise Bad(f'{self.build}: there is no program flankfilm')
        if self.out.exists() and not (self.out / 'numbers').exists():
            raise Bad(f'{self.out}: this folder holds something else')
        for folder in (self.out, self.lab):
            shutil.rmtree(folder, ignore_errors=True)
        for name in ('numbers', 'bytes', 'pages'):
            (self.out / name).mkdir(parents=True)
        shutil.copytree(self.source / 'configs', self.work / 'configs')
        shutil.copytree(self.source / 'tests/bad/yaml', self.work / 'bad')
        self.environment = {
            'PATH': os.environ['PATH'], 'HOME': str(self.lab), 'TMPDIR': str(self.lab), 'LC_ALL': 'C.UTF-8',
            'OPENBLAS_NUM_THREADS': '1', 'FLANKFILM_PLUGIN_PATH': str(self.lab / 'plugins'),
        }
        self.environment['LD_PRELOAD'] = self.compile('clock.c', self.lab / 'clock.so')
        self.commands = re.findall(r'^  ([a-z]+) ', self.run(['--help'])[1].decode(), re.M)
        self.models = [m['id'] for m in json.loads(self.run(['models', '--json'])[1])['models']]

    def compile(self, file, to, *options):
        to.parent.mkdir(parents=True, exist_ok=True)
        command = [*shlex.split(os.environ.get('CC', 'cc')), '-O1', '-fPIC', '-shared', f'-I{HERE.parent}/abi/1.0',
                   *options, '-o', str(to), str(HERE / file)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise Bad(f'{file} does not compile:\n{done.stderr}')
        return str(to)

    def run(self, words):
        """Exit code, stdout, stderr."""
        try:
            done = subprocess.run([self.build / 'flankfilm', *words], cwd=self.work, env=self.environment,
                                  stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            raise Bad(f'flankfilm {" ".join(words)}: it took more than {PATIENCE} s') from None
        return done.returncode, done.stdout, done.stderr

    def keep(self, group, name, data):
        """Writes a record, without what no two builds have in common."""
        path = self.out / group / (re.sub(r'[^\w.=-]+', '_', name).strip('_') or 'no-words')
        if path.exists():
            raise Bad(f'{path}: this was recorded before')
        for folder, word in ((self.lab, b'LAB'), (self.build, b'BUILD'), (self.source, b'SOURCE')):
            data = data.replace(os.fsencode(folder), word)
        for pattern, word in scenes.NORMAL:
            data = re.sub(pattern, word, data)
        path.write_bytes(data)

    def files(self):
        """The files that commands have written, with their times."""
        found = {}
        for folder, below, names in os.walk(self.work):
            below[:] = sorted(set(below) - {'configs', 'bad', *scenes.UNREAD})
            for path in (os.path.join(folder, name) for name in names):
                found[os.path.relpath(path, self.work)] = os.stat(path).st_mtime_ns
        return found

    def command(self, line, **fill):
        """Records how a command ended, what it said, and which files it wrote."""
        words, before, hashed = [], self.files(), []
        for word in line.split():
            words += flags(scenes.COARSE.get(fill['name'], [])) if word == '{coarse}' else [word.format(**fill)]
        if words and words[0].isalpha() and words[0] not in self.commands:
            return
        name = line.replace(' {coarse}', '').format(**{**fill, 'build': '', 'coarse': ''})
        code, said, complained = self.run(words)
        parts = [b'exit %d\n--- stdout\n' % code, said, b'--- stderr\n', complained]
        for file, time in sorted(self.files().items()):
            if before.get(file) == time:
                continue
            data = (self.work / file).read_bytes()
            if file.endswith(('.html', '.svg')):
                self.keep('pages', f'{name} {file}', data)
            elif re.search(r'[0-9a-f]{16}', file):  # a name that holds the bytes of plugins
                hashed.append(f'--- {os.path.dirname(file)}: {digest(data)}\n'.encode())
            elif b'\0' in data:  # NetCDF, whose bytes differ each time
                parts.append(f'--- {file}\n'.encode())
            else:
                parts += [f'--- {file}\n'.encode(), data]
        self.keep('bytes', name, b''.join(parts + sorted(hashed)))

    def bytes(self):
        for pattern, *lines in scenes.FILES:
            for file in sorted(self.work.glob(pattern)):
                for line in lines:
                    self.command(line, file=str(file.relative_to(self.work)), name=file.stem)
        for line in scenes.COMMANDS:
            self.command(line, build=f'{self.build}/', out='out-line-contact', map='out-film-map')
        for text in scenes.WRONG:
            self.command('check {pair} --set {text}', pair=scenes.PAIR, text=text)
            self.command('check {pair} --json --set {text}', pair=scenes.PAIR, text=text)
        for name in sorted(self.commands):
            self.command('help {name}', name=name)
        for model in self.models:
            for line in ('models {model}', 'models {model} --json', 'models {model} --markdown'):
                self.command(line, model=model)
        for kind in sorted({model.split('/')[0] for model in self.models}):
            self.command('new {kind}/mine -o new-{kind}', kind=kind)

    def sink(self, model):
        """Compiles the stage that takes all outputs of a model. Its id; None: there are no numbers to take."""
        name = model.replace('/', '-')
        rows = [r for r in json.loads(self.run(['models', model, '--json'])[1])['outputs'] if not r['service']]
        text = ''.join(f'{{.name = "from.{r["name"]}", .unit = "{r["unit"]}", .doc = "-", .dims = "{r["dims"]}", '
                       '.flags = FF_OPTIONAL},\n' for r in rows)
        if rows and not (self.lab / f'plugins/sink/{name}.so').exists():
            (self.lab / 'rows.h').write_text(text)
            self.compile('sink.c', self.lab / f'plugins/sink/{name}.so', f'-DROWS="{self.lab}/rows.h"', f'-DID="sink/{name}"')
        return f'sink/{name}' if rows else None

    def scene(self, name, file, sets):
        """All outputs of all stages of a case: scalars as they are, arrays hashed."""
        code, said, _ = self.run(['explain', file, '--json', *flags(sets)])
        stages = json.loads(said)['stages'] if code == 0 else []
        chosen = any(s['model'].endswith('/auto') for s in stages)
        bits, more = {}, []
        for stage, model in ((s['stage'], s['model']) for s in stages if not chosen):
            sink = self.sink(model)
            if sink:
                bits[stage] = self.lab / f'bits/{name}.{stage}'
                more.append(f'sink_{stage}={{use: {sink}, from: {stage}, file: {bits[stage]}}}')
        if bits:
            (self.lab / 'bits').mkdir(exist_ok=True)
            more.append('outputs=[' + ', '.join(f'sink_{stage}.taken' for stage in bits) + ']')
        if bits or chosen:
            code, said, _ = self.run(['run', file, '--json', *flags([*sets, *more])])
        lines = [f'exit {code}']
        if code or not stages:
            lines += [error['message'] for error in json.loads(said)['errors']]
            print(f'{name} has no numbers: {lines[-1]}', flush=True)
        elif chosen:  # a stage that chooses is no stage to take from: the digits that are printed
            lines += [f'{key} {digest(json.dumps(row.get("data", row.get("value"))).encode())}'
                      for key, row in json.loads(said)['outputs'].items()]
        for stage, path in bits.items():
            lines += [f'{stage}.{line}' for line in blocks(path.read_bytes() if path.exists() else b'')]
        self.keep('numbers', name, '\n'.join([*lines, '']).encode())

    def cases(self, name):
        """Scalars and quality of each case of a study, from its journal, which has all their digits."""
        path, lines = self.work / f'out-{name}/journal.jsonl', []
        for row in records.read(path) if path.exists() else [{'case': 'nothing was run'}]:
            case = f'{row.get("case")} {row.get("status")}'
            lines += [f'{case} {key} {exact(value)}' for key, (_, value) in row.get('outputs', {}).items()]
            lines += [f'{case} {stage}.{key} {exact(q[0])} {exact(q[1])}'
                      for stage, quality in row.get('quality', {}).items() for key, q in quality.items()]
        self.keep('numbers', f'study-{name}', '\n'.join([*lines, '']).encode())

    def numbers(self):
        for file in sorted(self.work.glob('configs/**/*.yaml')):
            if (self.work / f'out-{file.stem}/journal.jsonl').exists():
                self.cases(file.stem)
            else:
                self.scene(file.stem, str(file.relative_to(self.work)), [])
        for name, (file, sets) in scenes.SCENES.items():
            self.scene(f'with-{name}', file, sets)

    def studies(self):
        """Runs the studies for their numbers alone."""
        for file in sorted(self.work.glob('configs/[os]*/*.yaml')):
            self.run(['run', str(file.relative_to(self.work)), '-j', '1', '-o', f'out-{file.stem}',
                      *flags(scenes.COARSE.get(file.stem, []))])

    def all(self, texts):
        """Records the values, and what commands say and write if `texts`."""
        if texts:
            self.bytes()
        else:
            self.studies()
        self.numbers()
        shutil.rmtree(self.lab)


def blocks(data):
    """Lines of what a sink has written: blocks of a name, the lengths of its dimensions, and raw doubles."""
    at = 0
    while at < len(data):
        end = data.index(b'\n', at)
        name, *shape = data[at:end].decode().split()
        at = end + 1 + 8 * prod(map(int, shape))
        raw = data[end + 1:at]
        yield f'{name} {"x".join(shape)} {digest(raw)}' if shape else f'{name} {exact(struct.unpack("d", raw)[0])}'
