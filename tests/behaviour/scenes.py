"""What is recorded of a build: tables of scenes and commands, and what of their output is not compared."""

PAIR = 'configs/li-kahraman-2011.yaml'
FAST = ['mesh.use=stiffness/potential-energy', 'film.cells=64', 'film.steps=100', 'film.contact=static',
        'film_static.cells=64', 'film_static.steps=100']
RANGE = ['motion.atlas.from=1000 Hz', 'motion.atlas.to=1500 Hz']
DISCS = 'configs/line-contact.yaml'

# Every configs/*.yaml runs as it is, with all outputs of all stages, and so do these: each model once.
SCENES = {
    'iso-6336': (PAIR, [*FAST, 'mesh.use=stiffness/iso-6336']),
    'stiffness-table': (PAIR, [*FAST, 'mesh.use=stiffness/table', 'mesh.phase=[0,0.4,0.8]',
                               'mesh.stiffness=[4e8 N/m,6e8 N/m,5e8 N/m]', 'tooth.load=motion', 'static.load=motion']),
    'coupled': (PAIR, [*FAST, 'motion.use=dynamics/coupled', 'motion.bearing_stiffness=[2e8 N/m,2e8 N/m]',
                       'motion.tolerance=1e-6']),
    'harmonic-balance': (PAIR, [*FAST, 'motion.use=dynamics/harmonic-balance', 'motion.harmonics=16']),
    'shooting': (PAIR, [*FAST, *RANGE, 'motion.search_speeds=4', 'motion.search_starts=4']),
    'time-integration': (PAIR, [*FAST, 'motion.use=dynamics/time-integration']),
    'quasi-static': (PAIR, [*FAST, *RANGE, 'slow.use=dynamics/quasi-static', 'static.load=slow']),
    'upper-branch': (PAIR, [*FAST, *RANGE, 'duty.mesh_frequency=2375 Hz', 'motion.branch=upper',
                            'film.contact=tooth']),
    'control-volume': (PAIR, [*FAST, *RANGE, 'film.use=ehl/control-volume']),
    'dense-newton': (DISCS, ['film.use=ehl/dense-newton', 'film.cells=64']),
    'film-formula': (PAIR, [*FAST, *RANGE, 'film.use=ehl/film-formula']),
    'inlet-analysis': (PAIR, [*FAST, *RANGE, 'film.use=ehl/inlet-analysis']),
    'cavitation': (DISCS, ['film.cells=128', 'film.cavitation=mass-conserving', 'discs.duration=1 ms']),
    'sinusoidal': (DISCS, ['film.cells=128', 'discs.duration=1 ms', 'film.steps=100',
                           'rough={use: surface/sinusoidal, amplitude: 0.1 um, wavelength: 100 um}']),
    'dent': (DISCS, ['film.cells=128', 'discs.duration=1 ms', 'film.steps=100',
                     'rough={use: surface/dent, depth: 0.2 um, width: 50 um}']),
    **{law: (DISCS, ['film.cells=128', f'viscosity.use=viscosity/{law}'])
       for law in ('barus', 'roelands', 'two-slope', 'isoviscous')},
    **{law: (DISCS, ['film.cells=128', f'density.use=density/{law}']) for law in ('incompressible', 'tait')},
    **{law: (DISCS, ['film.cells=128', f'flow.use=rheology/{law}']) for law in ('newtonian', 'carreau')},
}

# Settings of a study, and of a case where its bytes are recorded; what is not named here runs as it is. All of
# them with configs/ as it is would take an hour.
FILM = ['film.cells=96', 'film.steps=100']
COARSE = {
    'li-kahraman-2011': [*FILM, 'film_static.cells=96', 'film_static.steps=100'],
    'line-contact': ['film.cells=96'],
    **{name: FILM for name in ('light-load', 'mesh-losses', 'mixed-film', 'own-gear', 'profile-relief', 'table-contact')},
    'film-map': ['study.sweep.duty.torque.points=3', 'study.sweep.duty.mesh_frequency.points=4'],
    'lubricants-by-laws': ['film.cells=64', 'film.steps=100'],
    'speed-sweep': ['study.sweep.duty.mesh_frequency.points=19'],
    'stability-alpha': ['film.cells=256', 'study.stability.axes.discs.load_per_width.points=3',
                        'study.stability.axes.viscosity.alpha.points=3'],
    'stability-cycle': ['study.stability.axes.film.steps={from: 125, to: 250, points: 2}',
                        'study.stability.axes.film.cells={from: 64, to: 128, points: 2}'],
    'stability-dynamics': ['study.stability.axes.duty.mesh_frequency.points=2',
                           'study.stability.axes.motion.damping_ratio.points=2'],
    'stability-film': ['film.cells=128', 'study.stability.axes.discs.load_per_width.points=3',
                       'study.stability.axes.discs.entrainment_speed.points=3'],
    'stability-gear': ['film.cells=128', 'film.steps=200', 'study.stability.axes.duty.mesh_frequency.points=2',
                       'study.stability.axes.duty.torque.points=2'],
    'stability-rheology': ['study.stability.axes.discs.load_per_width.points=3',
                           'study.stability.axes.film.cells={from: 128, to: 256, points: 2}'],
    'stability-rough': ['film.cells=64', 'film.steps=100', 'study.stability.axes.rough.rq.points=2',
                        'study.stability.axes.duty.mesh_frequency.points=2'],
    'tradeoff-dynamics': ['study.tradeoff.repeats=1'],
    'tradeoff-film': ['study.tradeoff.repeats=1', 'study.tradeoff.reference={film.cells: 128, film.steps: 200}',
                      'study.tradeoff.candidates=[{film.use: [ehl/film-formula, ehl/finite-volume], '
                      'film.cells: [64, 128], film.steps: 100}]'],
    'tradeoff-laws': ['study.tradeoff.repeats=1', 'film.cells=64', 'film.steps=100',
                      'study.tradeoff.reference={film.cells: 64, film.steps: 100, refinements: 1}'],
    'tradeoff-rough': ['study.tradeoff.repeats=1', 'study.tradeoff.reference={film.cells: 128, film.steps: 100}',
                       'study.tradeoff.candidates=[{film.surface: none, film.cells: 64, film.steps: 50}, '
                       '{film.cells: [64, 128], film.steps: 50}]'],
    'tradeoff-scene': ['study.tradeoff.repeats=1', 'film.cells=64', 'film.steps=100',
                       'study.tradeoff.reference={film.cells: 64, film.steps: 100, refinements: 1}'],
    'tradeoff-stiffness': ['study.tradeoff.repeats=1', 'study.tradeoff.reference={mesh.use: '
                           'stiffness/load-distribution, mesh.elements_per_tooth: 900}'],
}

# Settings of the pair that are wrong, each in its way, or that deserve a warning.
WRONG = (
    'duty.torque=250', 'duty.torque=250 N mm um', 'duty.torque=-1 N m', 'duty.torqe=250 N m', 'duty.speed=1500',
    'duty.speed=1500 rpm', 'nobody.cells=4', 'film.cells=12.5', 'film.cells=1', 'film.cells=[1, 2]', 'film.inlet=1',
    'film.wedge=third', 'film.use=ehl/finite-volumes', 'film.use=finite-volume', 'film.use=ehl/auto',
    'film.contact=', 'film.contact=nobody', 'film.contact=gears', 'film.contact=none', 'motion.branch=left',
    'mesh.use=stiffness/table', 'mesh.gear=film', 'gears.teeth=[50]', 'gears.teeth=[50.5, 50]', 'gears.module=0 mm',
    'gears.module={a: 1}', 'gears.tip_relief=20 um', 'outputs=[]', 'outputs=[film]', 'outputs=[film.none]',
    'outputs=[film.h_mn]', 'outputs=film.*', 'accuracy=2 %', 'accuracy=two', 'format=9', 'format=', 'study={}',
    'study={sweep: {}}', 'study={sweep: {duty.torque: [1 N m, 2]}}', 'study={sweep: {duty.torqe: [1 N m]}}',
    'study={nothing: {}}', 'study={sweep: {duty.torque: {from: 1 N m, to: 2 N m}}}', 'include=nothing.yaml',
    'title=', 'x-own=1', 'unknown=1', 'film=', 'film={use: ehl/finite-volume, contact: tooth, use: 1}', 'film.x=',
    'viscosity.alpha=11 1/GPa', 'viscosity.eta0=5', 'flow.tau0=5e9 MPa', '=1', 'film', 'pair.use=gear/involute-spur',
)

# Commands on files: {name} is that without its folder and ending, {coarse} what COARSE says of it.
FILES = (
    ('configs/*.yaml', 'run {file} -o out-{name} {coarse}', 'run {file} --json {coarse}', 'report out-{name}',
     'export out-{name} --to csv -o csv-{name}', 'export out-{name} --to netcdf -o {name}.nc'),
    ('configs/[os]*/*.yaml', 'run {file} -j 1 -o out-{name} {coarse}', 'report out-{name}',
     'export out-{name} --to csv -o csv-{name}'),
    ('configs/**/*.yaml', 'check {file}', 'check {file} --json', 'explain {file}', 'explain {file} --json',
     'explain {file} --yaml', 'cite {file}', 'plan {file}', 'plan {file} --json'),
    ('bad/*', 'check {file}', 'check {file} --json', 'run {file}', 'explain {file}'),
)

# {out} and {map} are results of a case and of a study, {build} the folder of the build.
COMMANDS = (
    '', 'help', '--help', '--version', '--nothing', 'help nothing', 'help rum', 'run', 'run a b', 'run nothing.yaml',
    'run --sett a=1', 'run -j 0 x.yaml', 'run --shard 3/2 x.yaml', 'run --rerun some x.yaml', 'run -q', 'run --json=1',
    'check --json', 'check nothing.yaml', 'check configs', 'explain nothing.yaml', 'models nothing', 'models gear',
    'models gear/nothing', 'models --json', 'models --markdown', 'models', 'schema', 'schema schema.json',
    'new viscosity', 'new viscosity/a_b', 'verify nothing.so', 'verify configs/demo.sh', 'export {out}',
    'export {out} --to csv', 'export {out} --to nothing', 'export {out} --to csv --json', 'export {map} --to csv -o csv',
    'export configs --to csv', 'report nothing', 'report configs', 'report {map} -o map.html',
    'report {out} --json', 'export {out} --to csv --with nothing=1', 'fit', 'fit density configs/measured/pao-b.csv',
    'fit viscosity nothing.csv', 'fit viscosity configs/measured/pao-b.csv', 'fit viscosity configs/surfaces/ground-driven.csv',
    'fit viscosity configs/measured/pao-b.csv --at 80degC --at 0.3GPa -o fit',
    'fit viscosity configs/measured/pao-b.csv --at 80degC --json',
    'fit viscosity configs/measured/pao-b.csv --at 40degC --law roelands --law barus',
    'fit viscosity configs/measured/pao-b.csv --law nothing --at 80degC',
    'run configs/table-contact.yaml --set film.cells=64 --set film.steps=50 --strict',
    'run configs/table-contact.yaml --executor mpi', 'run configs/table-contact.yaml --shard 1/2',
    'run configs/studies/film-map.yaml --set outputs=film.h_min_lowest --shard 2/99 -o shard -j 1',
    'run configs/studies/film-map.yaml -o {map} -j 1', 'run configs/studies/film-map.yaml -o {map} --rerun failed -j 1',
    'run configs/studies/film-map.yaml -o {out}', 'run configs/table-contact.yaml -o configs',
    'run configs/table-contact.yaml -o {map}', 'plan configs/studies/film-map.yaml -o {map}',
)

# `verify` of these modules is quick; the others are tests of their own.
COMMANDS += tuple(f'verify {{build}}plugins/{model}.so' for model in (
    'viscosity/barus', 'viscosity/doolittle-tait', 'viscosity/isoviscous', 'viscosity/roelands', 'viscosity/two-slope',
    'density/dowson-higginson', 'density/incompressible', 'density/tait', 'rheology/carreau', 'rheology/newtonian',
    'contact/constant', 'surface/dent', 'surface/sinusoidal', 'executor/mpi'))
COMMANDS += tuple(f'verify {{build}}plugins/{model}.so --pipeline {PAIR} --set {stage}.use={model}' for model, stage in (
    ('gear/involute-spur', 'gears'), ('operating/steady', 'duty'), ('stiffness/iso-6336', 'mesh'),
    ('contact/tooth-pair', 'tooth')))

# Not compared: (pattern, what stands there instead). Durations are those of clock.c, the same in every run.
NORMAL = (
    (rb'(?<![0-9a-f.])[0-9a-f]{16}(?![0-9a-f.])', b'KEY'),  # hashes of a case or a module: of the bytes of plugins
    (rb'\.[0-9]+\.part\b', b'.PID.part'),
    (rb'computed on"?[:,] ?"[^"]*"', b'computed on MACHINE'),
    (rb'"seconds":[0-9.e+-]+', b'"seconds":S'),
    (rb'note=\{commit [0-9a-f]+(-dirty)?\}', b'note={commit COMMIT}'),
)
UNREAD = ('stages',)  # results that cases take over from each other, with times
