// Files in one, as they are: a ZIP without compression (PKWARE's APPNOTE 6.3, 4.3).

export type NamedFile = {name: string; bytes: Uint8Array};

const crcTable = Uint32Array.from({length: 256}, (_, i) => {
  let value = i;
  for (let bit = 0; bit < 8; ++bit) {
    value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  }
  return value;
});

function crcOf(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc = crcTable[(crc ^ byte) & 0xff] ^ (crc >>> 8);
  }
  return (crc ^ 0xffffffff) >>> 0;
}

/** Numbers of so many bytes, lowest first. */
function packed(numbers: [number, 2 | 4][]): Uint8Array {
  const view = new DataView(new ArrayBuffer(numbers.reduce((sum, [, n]) => sum + n, 0)));
  let at = 0;
  for (const [value, n] of numbers) {
    if (n === 2) {
      view.setUint16(at, value, true);
    } else {
      view.setUint32(at, value, true);
    }
    at += n;
  }
  return new Uint8Array(view.buffer);
}

/** More needs other numbers (Zip64). */
export const mostFiles = 65535, mostBytes = 2 ** 32 - 1;

const version = 20, noFlags = 0, stored = 0, midnight = 0, firstOf1980 = 0x21;

/** At most `mostFiles`, all in all less than `mostBytes`; names of ASCII. */
export function zipOf(files: NamedFile[]): Blob {
  const parts: Uint8Array[] = [], directory: Uint8Array[] = [];
  let at = 0;
  for (const {name, bytes} of files) {
    const letters = new TextEncoder().encode(name);
    const facts: [number, 2 | 4][] = [[version, 2], [noFlags, 2], [stored, 2], [midnight, 2], [firstOf1980, 2], [crcOf(bytes), 4],
      [bytes.length, 4], [bytes.length, 4], [letters.length, 2], [0, 2]];
    const head = packed([[0x04034b50, 4], ...facts]);
    parts.push(head, letters, bytes);
    // No comment, the first disk, no attributes, and where it begins.
    directory.push(packed([[0x02014b50, 4], [version, 2], ...facts, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]]), letters);
    at += head.length + letters.length + bytes.length;
  }
  const length = directory.reduce((sum, part) => sum + part.length, 0);
  const end = packed([[0x06054b50, 4], [0, 2], [0, 2], [files.length, 2], [files.length, 2], [length, 4], [at, 4], [0, 2]]);
  return new Blob([...parts, ...directory, end], {type: "application/zip"});
}
