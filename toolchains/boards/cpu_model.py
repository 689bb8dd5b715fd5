"""Predicts the cycles of a frame on a processor: the program's executed blocks, times llvm-mca's cycles for each.

QEMU counts the executions of each block of instructions (block_counts.c). llvm-mca computes the cycles that a
block takes on a processor if it is repeated with all data in the first-level cache. If a block is a loop of its
own, these cycles are its time. All other blocks run once at a time. An out-of-order processor overlaps such a
block with the next ones; so only the execution units that it uses count. An in-order processor does not overlap
blocks; so all cycles count. The sum over all blocks is the prediction. predict.py adds memory traffic and cores.
"""
import collections
import json
import re
import subprocess
import tempfile

LLVM = '19'
ITERATIONS = 50


class Counts:
    """Number of executions of each block. The key is the block's offset from the start of the program's code and its
    size in bytes."""

    def __init__(self, text=''):
        self.blocks = {}  # (offset, bytes): (instructions, count)
        self.other = 0  # instructions of libraries
        for line in text.splitlines():
            words = line.split()
            if words[0] == 'other':
                self.other += int(words[1])
                continue
            key = int(words[0], 16), int(words[1])
            size, count = int(words[2]), int(words[3])
            self.blocks[key] = size, self.blocks.get(key, (size, 0))[1] + count

    def less(self, before, share):
        """Returns (these counts - `before`) * `share`: the counts of frames without the start of the program."""
        out = Counts()
        for key, (size, count) in self.blocks.items():
            more = count - before.blocks.get(key, (size, 0))[1]
            if more > 0:
                out.blocks[key] = size, more * share
        out.other = max(self.other - before.other, 0) * share
        return out

    def instructions(self):
        return sum(size * count for size, count in self.blocks.values())



def code_address(readelf):
    """Address of the program's executable segment. `readelf`: output of `readelf -lW`."""
    for line in readelf.splitlines():
        words = line.split()
        if words[:1] == ['LOAD'] and 'E' in words[6:-1]:
            return int(words[2], 16)
    raise ValueError('the program has no executable segment')


def instruction_text(line):
    """Parses a line of llvm-objdump: (address, instruction as llvm-mca reads it, target of a branch or 0). None if
    the line is no instruction."""
    found = re.match(r'\s*([0-9a-f]+):\s+(\S.*)', line)
    if not found:
        return None
    text = re.sub(r'\s*(//|#\s|<unknown>).*', '', found.group(2).replace('\t', ' '))
    # The branch target is replaced by a name, because the assembler refuses targets that are too
    # far away.
    branch = re.search(r'#?0x([0-9a-f]+) <[^>]*>', text)
    text = re.sub(r'#?-?0x[0-9a-f]+ <[^>]*>', 'target', text)
    return int(found.group(1), 16), text.strip(), int(branch.group(1), 16) if branch else 0


def disassemble(program):
    """Returns the program's instructions in their order: {address: (text, target of a branch or 0)}."""
    out = {}
    command = ['llvm-objdump-' + LLVM, '-d', '--no-show-raw-insn', program]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as run:
        for line in run.stdout:
            got = instruction_text(line)
            if got:
                out[got[0]] = got[1:]
    return out


ENDS = re.compile(r'(j\w+|call\w*|ret\w*|b|bl|br|blr|cbn?z|tbn?z|b\.\w+)( |$)')


def basic_blocks(counts, base, texts):
    """Returns the basic blocks: [(addresses of the instructions, number of executions)]. QEMU's own blocks are not
    used, because they end at page borders and can overlap; so they change whenever the linker moves code."""
    ran = {}
    for (offset, size), (_, count) in counts.blocks.items():
        for address in range(base + offset, base + offset + size):
            if address in texts:
                ran[address] = ran.get(address, 0) + count
    leaders = {target for _, target in texts.values()}
    out, last = [], None  # the previous instruction, if it ran and does not end a block
    for address, (text, _) in texts.items():
        if address not in ran:
            last = None
            continue
        if last is None or address in leaders or ran[address] != ran[last]:
            out.append(([], ran[address]))
        out[-1][0].append(address)
        last = None if ENDS.match(text) else address
    return out


def hottest(blocks, share):
    """Returns the smallest set of blocks that contains this share of the executed instructions."""
    ordered = sorted(blocks, key=lambda block: -len(block[0]) * block[1])
    rest = sum(len(addresses) * count for addresses, count in blocks) * share
    out = []
    for addresses, count in ordered:
        if rest <= 0:
            break
        out.append((addresses, count))
        rest -= len(addresses) * count
    return out


def mca_source(blocks, texts):
    """Returns assembler text for llvm-mca, with one region per block. `blocks`: addresses of the instructions."""
    lines = []
    for at, addresses in enumerate(blocks):
        lines.append(f'# LLVM-MCA-BEGIN b{at}')
        lines += [texts[address][0] for address in addresses]
        lines.append('# LLVM-MCA-END')
    return '\n'.join(lines) + '\n'


def mca_cycles(answer):
    """Returns for each region (block) in llvm-mca's output: (cycles of one iteration in a sequence of iterations,
    smallest number of cycles that its execution units allow)."""
    out = {}
    for region in json.loads(answer)['CodeRegions']:
        view = region.get('SummaryView')
        if view:
            out[region['Name']] = view['TotalCycles'] / view['Iterations'], view['BlockRThroughput']
    return out


def is_loop(addresses, texts):
    return texts[addresses[-1]][1] == addresses[0]


def block_cycles(blocks, texts, cpu, arm):
    """Returns the cycles of each block on the processor `cpu` (an entry of cpus in model.toml). None for a block
    with an instruction that llvm-mca does not know."""
    triple = 'aarch64-linux-gnu' if arm else 'x86_64-linux-gnu'
    with tempfile.NamedTemporaryFile('w', suffix='.s') as source:
        source.write(mca_source(blocks, texts))
        source.flush()
        run = subprocess.run(
            ['llvm-mca-' + LLVM, f'-mtriple={triple}', f'-mcpu={cpu["mca"]}', f'-iterations={ITERATIONS}', '-json',
             '-skip-unsupported-instructions=any', source.name], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(f'llvm-mca for {cpu["mca"]}: {run.stderr[:2000]}')
    cycles = mca_cycles(run.stdout)
    out = []
    for at, block in enumerate(blocks):
        row, least = cycles.get(f'b{at}', (None, None))
        out.append(row if cpu['in_order'] or is_loop(block, texts) else least)
    return out


def source_files(program, addresses):
    """Returns the source file of the outermost function at each address, from the program's line tables."""
    run = subprocess.run(['llvm-symbolizer-' + LLVM, '--obj=' + program, '--output-style=JSON', '--relative-address'],
                         input='\n'.join(hex(a) for a in addresses) + '\n', capture_output=True, text=True, check=True)
    out = []
    for line in run.stdout.splitlines():
        frames = json.loads(line).get('Symbol', [])
        out.append(frames[-1]['FileName'] if frames else '')
    return out


def step_of(file, steps):
    """Returns the first step with a path part (model.toml) that occurs in the file's path, or 'rest'."""
    for step, parts in steps.items():
        if any(part in file for part in parts):
            return step
    return 'rest'


def frame_cycles(program, counts, cpus, steps, arm, coverage=0.99):
    """Returns million cycles of a frame on one core, for each processor and step, and million instructions for each
    step. `cpus` contains the processors, as in model.toml.

    llvm-mca gets the hottest blocks, which contain the share `coverage` of the executed instructions. All other
    blocks, and blocks that llvm-mca does not know, are assumed to take as many cycles per instruction as the hottest
    blocks of their step.
    """
    base = code_address(subprocess.run(['readelf', '-lW', program], capture_output=True, text=True, check=True).stdout)
    texts = disassemble(program)
    everything = basic_blocks(counts, base, texts)
    hot = hottest(everything, coverage)
    blocks = [addresses for addresses, _ in hot]
    sizes = [len(addresses) * count for addresses, count in hot]
    which = [step_of(file, steps) for file in source_files(program, [addresses[0] for addresses in blocks])]
    instructions = collections.Counter()
    for step, size in zip(which, sizes):
        instructions[step] += size
    more = sum(len(addresses) * count for addresses, count in everything) / sum(sizes)
    out = {'instructions': {step: n * more / 1e6 for step, n in instructions.items()},
           'library': counts.other / 1e6, 'cycles': {}}
    for cpu, entry in cpus.items():
        cycles, known = collections.Counter(), collections.Counter()
        for (_, count), size, step, one in zip(hot, sizes, which, block_cycles(blocks, texts, entry, arm)):
            if one is not None:
                cycles[step] += one * count
                known[step] += size
        out['cycles'][cpu] = {step: cycles[step] * instructions[step] / known[step] * more / 1e6
                              for step in known}
    return out
