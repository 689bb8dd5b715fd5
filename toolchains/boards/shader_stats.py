"""Reads the output of mfar-compile-shaders: statistics of each shader as compiled by a driver.

For each shader, a driver prints a line of statistics, and the shader in NIR (Mesa's intermediate language) just
before it becomes machine code. The statistics count each instruction once. The NIR shows the loops, from which
follows how often instructions run.
"""
import dataclasses
import re

SCRATCH = ('load_scratch', 'store_scratch')
MEMORY = re.compile(r'(load|store)_(ssbo|global|shared|scratch)|atomic|image_(load|store)|imadd.*store')


@dataclasses.dataclass
class Loop:
    """A loop of a shader, without the loops in it. Its operations run as often as those of the outer loop, times its own
    trip count. The first entry of Shader.loops is the whole shader."""
    depth: int
    parent: int = -1
    arithmetic: int = 0
    memory: int = 0  # accesses to storage, images, shared memory and local arrays
    texture: int = 0


@dataclasses.dataclass
class Shader:
    name: str
    defines: str
    instructions: int = 0
    nops: int = 0
    threads: int = 1
    registers: int = 0
    spills: int = 0
    fills: int = 0
    scratch: int = 0  # accesses to local arrays in memory, each counted once
    cycles: dict = dataclasses.field(default_factory=dict)  # cycles of one invocation by unit, with loops run once
    loops: list = dataclasses.field(default_factory=list)

    @property
    def key(self):
        return (self.name + ' ' + self.defines).strip()

    def weights(self, trips):
        """Returns the mean number of executions of an operation in one invocation: (arithmetic, memory, texture).
        `trips` contains the trip count of each loop, in order."""
        runs = [1.0]
        for loop, count in zip(self.loops[1:], trips):
            runs.append(runs[loop.parent] * count)
        out = []
        for kind in ('arithmetic', 'memory', 'texture'):
            stands = sum(getattr(loop, kind) for loop in self.loops)
            weighed = sum(getattr(loop, kind) * n for loop, n in zip(self.loops, runs))
            out.append(weighed / stands if stands else 1.0)
        return out

    def executed(self, kind, trips):
        """Returns the number of operations of a kind that one invocation executes."""
        weights = dict(zip(('arithmetic', 'memory', 'texture'), self.weights(trips)))
        return sum(getattr(loop, kind) for loop in self.loops) * weights[kind]


class NirReader:
    """Parses a shader's NIR line by line."""

    def __init__(self):
        self.loops = [Loop(0)]
        self.scratch = 0
        self._braces = []
        self._inside = [0]

    def line(self, line):
        text = line.strip()
        if text.startswith('} else'):
            return
        if text.endswith('{'):
            self._braces.append(re.match(r'(con |div )?loop\b', text) is not None)
            if self._braces[-1]:
                self.loops.append(Loop(len(self._inside), self._inside[-1]))
                self._inside.append(len(self.loops) - 1)
        elif text.startswith('}'):
            if self._braces and self._braces.pop():
                self._inside.pop()
        else:
            self._operation(text)

    def _operation(self, text):
        here = self.loops[self._inside[-1]]
        intrinsic = re.search(r'(?:intrinsic |@)(\w+)', text)
        if intrinsic:
            name = intrinsic.group(1)
            if MEMORY.search(name):
                here.memory += 1
            if name.startswith(SCRATCH):
                self.scratch += 1
        elif re.search(r'\)(tex|tx[bdfl]|tg4)\b', text):
            here.texture += 1
        elif re.search(r'(ssa_|%)\d+ = ', text) and 'load_const' not in text and ' phi ' not in text \
                and 'undef' not in text:
            here.arithmetic += 1


def number(text, pattern, default=0):
    found = re.search(pattern, text)
    return float(found.group(1)) if found else default


def _fill(shader, text):
    shader.instructions = int(number(text, r'(\d+) inst(?:r\b|s\b|,)'))
    shader.threads = int(number(text, r'(\d+) threads', 1))
    spills = re.search(r'(\d+):(\d+) spills:fills', text)
    if spills:
        shader.spills, shader.fills = int(spills.group(1)), int(spills.group(2))


def _v3d(shader, text):
    _fill(shader, text)
    shader.registers = int(number(text, r'(\d+) max-temps'))
    shader.nops = int(number(text, r'(\d+) nops'))


def _mali(shader, text):
    _fill(shader, text)
    units = r'([\d.]+) (arith|texture|vary|ldst|fma|cvt|sfu|v|t|ls)\b'
    shader.cycles = {unit: float(cycles) for cycles, unit in re.findall(units, text)}
    # The driver does not report registers, only whether a core can hold all threads or half of
    # them.
    shader.registers = 32 if shader.threads == 2 else 64


def _adreno(shader, text):
    if 'instr' in text:
        _fill(shader, text)
        shader.nops = int(number(text, r'(\d+) nops'))
    if ' full' in text:
        shader.registers = int(number(text, r'(\d+) full'))
    for category in ('cat2', 'cat3', 'cat4', 'cat5', 'cat6'):
        if category in text:
            shader.cycles[category] = number(text, rf'(\d+) {category}')


STAGES = {'comp': ('COMPUTE', 'CL'), 'frag': ('FRAGMENT', 'FRAG'), 'vert': ('VERTEX', 'VERT', 'POSITION')}


def parse(lines):
    """Returns {key: Shader}, each as it was compiled last."""
    out, wanted, shader, nir, stage = {}, (), None, None, ''
    for line in lines:
        line = line.replace('MESA: info: ', '').rstrip('\n')
        # Adreno's driver prints from another thread, so a part of its line can precede the shader's name.
        named = re.search(r'shader: (\S+\.(comp|frag|vert))(?: (.*))?$', line)
        if named:
            name = named.group(1).rsplit('/', 1)[-1]
            shader = Shader(name, (named.group(3) or '').strip())
            out[shader.key] = shader
            wanted, nir, stage = STAGES[named.group(2)], None, ''
            continue
        if shader is None:
            continue
        begins = re.match(r'shader: MESA_SHADER_(\w+)', line)
        statistics = re.match(r'SHADER-DB\S*(?: -|:) MESA_SHADER_(\w+) shader: (.*)', line) or \
            re.match(r'; (\w+) prog \d+/\d+: (.*)', line)
        if begins:
            stage = begins.group(1)
            stage = {'KERNEL': 'COMPUTE'}.get(stage, stage)
            nir = NirReader() if stage in wanted else None
        elif statistics:
            if statistics.group(1) in wanted:
                _take(shader, statistics.group(2), line)
        elif nir is not None:
            if re.match(r'(impl |\}|\s)', line):
                nir.line(line)
                shader.loops, shader.scratch = nir.loops, nir.scratch
            elif line.startswith(('block', 'SIMD0', 'Native code', ';')):
                nir = None
        if re.search(r'\b(stp|ldp)\.', line) and stage in wanted:
            shader.cycles['private'] = shader.cycles.get('private', 0) + 1
    for one in out.values():
        if 'private' in one.cycles:  # Adreno does not distinguish spills from local arrays
            one.fills = max(int(one.cycles.pop('private')) - one.scratch, 0)
    return out


def _take(shader, text, line):
    if line.startswith(';'):
        _adreno(shader, text)
    elif 'max-temps' in text:
        _v3d(shader, text)
    else:
        _mali(shader, text)
