// Questions to the server of the studio; their paths are relative to the page, whose address holds the token.

async function answer(response) {
  const text = await response.text();
  let json;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error('the studio sent an answer that cannot be read');
  }
  if (!response.ok) throw new Error(json.error ?? `the studio refused (${response.status})`);
  return json;
}

async function to(path, options) {
  let response;
  try {
    response = await fetch(`api/${path}`, { cache: 'no-store', ...options });
  } catch {
    throw new Error('The studio does not answer: it was ended, or the computer slept. Nothing is lost: start “flank studio” again with the same folder.');
  }
  return answer(response);
}

export const get = (path) => to(path);
export const post = (path, json = {}) => to(path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(json) });
/** Sends a file; `kind` is "parts" (it is read at once) or "files". */
export const send = (kind, file, unit = '') => to(`${kind}?name=${encodeURIComponent(file.name)}${unit ? `&unit=${unit}` : ''}`, { method: 'POST', headers: { 'Content-Type': 'application/octet-stream' }, body: file });
export const place = (path) => `api/${path.split('/').map(encodeURIComponent).join('/')}`;
