// SPDX-License-Identifier: BSD-3-Clause
// The blocks of data in the page: zlib streams in base64.

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Bytes of the block `id`. */
export async function readBlock(id) {
  const bytes = fromBase64(document.getElementById(id).textContent);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function readJson(id) {
  return JSON.parse(new TextDecoder().decode(await readBlock(id)));
}
