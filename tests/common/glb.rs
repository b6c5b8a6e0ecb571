//! Binary glTF files made by hand.

/// The file of this JSON and these numbers.
pub(crate) fn glb(json: &str, numbers: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], content: &[u8], filler: u8| {
        let padding = content.len().next_multiple_of(4) - content.len();
        let length = (content.len() + padding) as u32;
        [&length.to_le_bytes()[..], kind, content, &vec![filler; padding]].concat()
    };
    let body = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", numbers, 0)].concat();
    [&b"glTF\x02\0\0\0"[..], &(body.len() as u32 + 12).to_le_bytes(), &body].concat()
}

/// Little-endian 32-bit floats.
pub(crate) fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}
