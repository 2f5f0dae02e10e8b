//! Prefixes of names that nobody has declared.

use std::collections::BTreeSet;

/// The text with every prefix that it has declared in its root element. Files that a preprocessor has left
/// behind have prefixes that nobody declares; what carries one is not read, and no reason to refuse the
/// rest. Lines stay what they are.
pub(super) fn declared(text: &str) -> String {
    let is_name = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    let mut prefixes = BTreeSet::new();
    for (at, _) in text.match_indices(':') {
        let before = &text[..at];
        let start = before.rfind(|c| !is_name(c)).map_or(0, |i| i + 1);
        let prefix = &before[start..];
        let starts_name = prefix.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let after = text[at + 1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let opens = before[..start].ends_with(['<', '/', ' ', '\n', '\t', '\r']);
        if starts_name && after && opens && !["xml", "xmlns"].contains(&prefix) {
            prefixes.insert(prefix);
        }
    }
    let undeclared = prefixes.into_iter().filter(|p| !text.contains(&format!("xmlns:{p}")));
    let declarations: String = undeclared.map(|p| format!(" xmlns:{p}=\"{p}\"")).collect();
    // After the name of the first element, which no comment or declaration is.
    let mut from = 0;
    while let Some(open) = text[from..].find('<').map(|i| from + i) {
        let rest = &text[open + 1..];
        if rest.starts_with(is_name) {
            let end = rest.find(|c| !is_name(c) && c != ':').map_or(text.len(), |i| open + 1 + i);
            return format!("{}{declarations}{}", &text[..end], &text[end..]);
        }
        let close = if rest.starts_with("!--") { "-->" } else { ">" };
        let Some(end) = rest.find(close) else { break };
        from = open + 1 + end;
    }
    text.to_owned()
}
