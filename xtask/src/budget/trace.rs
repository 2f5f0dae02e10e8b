//! The instructions of ticks, from what QEMU writes down of a run
//! (`-singlestep -d in_asm,exec,nochain`).

use anyhow::{Context, Result, ensure};
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// One executed instruction.
#[derive(Clone)]
pub struct Executed {
    /// As the disassembler writes it, such as `vmul.f32`.
    pub mnemonic: String,
    /// Its operands.
    pub operands: String,
    /// Whether the next instruction is not the one behind it.
    pub is_jump: bool,
}

/// An instruction in memory.
struct Instruction {
    mnemonic: String,
    operands: String,
    length: u32,
}

/// The last `count` runs of the interrupt handler at `handler`, from its first instruction to its
/// return.
pub fn ticks(trace: &Path, handler: u32, count: usize) -> Result<Vec<Vec<Executed>>> {
    let file = File::open(trace).with_context(|| format!("{}", trace.display()))?;
    let mut memory: HashMap<u32, Instruction> = HashMap::new();
    let mut ticks: Vec<Vec<u32>> = Vec::new();
    let mut before = None;
    let mut return_to = None;
    for line in BufReader::new(file).split(b'\n') {
        let line = line?;
        let line = String::from_utf8_lossy(&line);
        if let Some(address) = executed(&line) {
            if return_to.is_none() && address == handler {
                // Where the code that was interrupted goes on.
                return_to = before.and_then(|at| Some(at + memory.get(&at)?.length));
                ticks.push(Vec::new());
            } else if return_to == Some(address) {
                return_to = None;
            }
            if return_to.is_some()
                && let Some(tick) = ticks.last_mut()
            {
                tick.push(address);
            }
            before = Some(address);
        } else if let Some((address, instruction)) = disassembled(&line) {
            memory.insert(address, instruction);
        }
    }
    ensure!(ticks.len() >= count, "the trace has {} ticks, and should have {count}", ticks.len());
    let last = ticks.split_off(ticks.len() - count);
    last.into_iter().map(|tick| decode(&tick, &memory)).collect()
}

fn decode(tick: &[u32], memory: &HashMap<u32, Instruction>) -> Result<Vec<Executed>> {
    tick.iter()
        .enumerate()
        .map(|(i, address)| {
            let instruction =
                memory.get(address).with_context(|| format!("no instruction at {address:#x}"))?;
            let next = tick.get(i + 1);
            Ok(Executed {
                mnemonic: instruction.mnemonic.clone(),
                operands: instruction.operands.clone(),
                is_jump: next.is_none_or(|next| *next != address + instruction.length),
            })
        })
        .collect()
}

/// `Trace 0: 0x7ff1b4001840 [00800408/080001a6/00000110/ff020201] Reset`
fn executed(line: &str) -> Option<u32> {
    let fields = line.strip_prefix("Trace ")?.split_once('[')?.1;
    u32::from_str_radix(fields.split('/').nth(1)?, 16).ok()
}

/// `0x08000188:  f011 f8c4  bl       #0x8011314`
fn disassembled(line: &str) -> Option<(u32, Instruction)> {
    let (address, rest) = line.strip_prefix("0x")?.split_once(": ")?;
    let address = u32::from_str_radix(address, 16).ok()?;
    let mut words = rest.split_whitespace().peekable();
    let mut length = 0;
    while words.next_if(|word| word.len() == 4 && u16::from_str_radix(word, 16).is_ok()).is_some() {
        length += 2;
    }
    let mnemonic = words.next()?.to_owned();
    let operands = words.collect::<Vec<_>>().join(" ");
    Some((address, Instruction { mnemonic, operands, length }))
}

#[cfg(test)]
mod tests {
    use super::{disassembled, executed};

    #[test]
    fn lines_of_the_trace_are_read() {
        let line = "Trace 0: 0x7ff1b4001840 [00800408/080001a6/00000110/ff020201] Reset";
        assert_eq!(executed(line), Some(0x0800_01a6));
        let (address, long) =
            disassembled("0x08000188:  f011 f8c4  bl       #0x8011314").expect("a line");
        assert_eq!((address, long.length, long.mnemonic.as_str()), (0x0800_0188, 4, "bl"));
        let (_, short) = disassembled("0x08011318:  bd80       pop      {r7, pc}").expect("a line");
        assert_eq!((short.length, short.operands.as_str()), (2, "{r7, pc}"));
        assert!(disassembled("IN: Reset").is_none() && executed("").is_none());
    }
}
