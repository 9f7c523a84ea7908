// Columns of numbers as the report packed them (packed_rods.py): base64 of a zlib stream, inside it all first bytes of the
// numbers, then all second ones, and so on.

const KINDS = { u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, f4: Float32Array };

export const UNKNOWN = 65535; // of 16-bit columns that say so: no value

export function supported() {
  return typeof DecompressionStream === "function";
}

/** The typed array of a column. */
export async function unpacked({ kind, element }) {
  const packed = Uint8Array.from(atob(document.getElementById(element).textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const Kind = KINDS[kind];
  return new Kind(interleaved(planes, Kind.BYTES_PER_ELEMENT).buffer);
}

function interleaved(planes, width) {
  const count = planes.length / width;
  const bytes = new Uint8Array(planes.length);
  for (let plane = 0; plane < width; plane++)
    for (let k = 0; k < count; k++) bytes[k * width + plane] = planes[plane * count + k];
  return bytes;
}
