// SPDX-License-Identifier: GPL-3.0-or-later
// Questions in a window over the page.

import { button, element } from "workbench/page/elements.js";

/** Whether `word` was chosen after these words, or `other`. */
export function agreed(id, title, lines, word, other = "Cancel") {
  return new Promise((done) => {
    const window_ = dialogue(id, title, lines.map((line) => ({ kind: "note", title: line })), word,
      () => done(true), other);
    window_.addEventListener("close", () => done(false)); // after an answer it is answered already
  });
}

/** Fields { name, title, kind: text|number|select|checkbox, value, choices, unit, note }; `done(values)`
 * when it is answered, which may take time; it is shown what goes wrong; null if there is nothing to ask.
 * Returns the dialogue. */
export function dialogue(id, title, fields, word, done, other = "Cancel") {
  const inputs = new Map();
  const wrong = element("p", { className: "words", role: "alert" });
  const window_ = element("dialog", { id, "aria-label": title }, element("h2", { textContent: title }),
    ...fields.map((field) => fieldLine(id, field, inputs)));
  const values = () => Object.fromEntries([...inputs].map(([name, input]) => [name,
    input.type === "checkbox" ? input.checked : input.value.trim()]));
  const close = () => { window_.close(); window_.remove(); };
  const go = button(word, async () => {
    try {
      wrong.textContent = "";
      if (done) await done(values(), (text) => { wrong.textContent = text; });
      close();
    } catch (problem) {
      wrong.textContent = problem.message;
    }
  }, { className: "main", id: `${id}-go` });
  window_.append(wrong, element("p", { className: "answers" }, done
    ? button(other, close, { id: `${id}-cancel` }) : null, go));
  window_.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target.tagName === "INPUT") { event.preventDefault(); go.click(); }
  });
  window_.addEventListener("cancel", () => setTimeout(() => window_.remove()));
  document.body.append(window_);
  window_.showModal();
  return window_;
}

function fieldLine(id, field, inputs) {
  if (field.kind === "note") return element("p", { className: "note", textContent: field.title });
  let input;
  if (field.kind === "select") {
    input = element("select", {}, ...field.choices.map(([value, textContent]) => element("option",
      { value, textContent })));
    if (field.value !== undefined) input.value = field.value;
  } else if (field.kind === "checkbox") {
    input = element("input", { type: "checkbox", checked: Boolean(field.value) });
  } else {
    input = element("input", { type: "text", value: field.value === undefined ? "" : String(field.value),
      spellcheck: false,
      autocomplete: "off", placeholder: field.hint || "" });
    if (field.kind === "number") { input.inputMode = "decimal"; input.className = "number"; }
  }
  input.id = `${id}-${field.name}`;
  inputs.set(field.name, input);
  const line = element("label", { for: input.id, className: "asked" }, element("span", { textContent: field.title }),
    input,
    element("span", { className: "unit", textContent: field.unit || "" }));
  if (!field.note) return line;
  return element("div", {}, line, element("p", { className: "note", textContent: field.note }));
}
