// SPDX-License-Identifier: GPL-3.0-or-later
// Making parts of the page. Texts are set as texts, so that no name can become markup.

/** An element with properties (`dataset` and `style` as objects), and its children. */
export function element(kind, properties = {}, ...children) {
  const made = document.createElement(kind);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "dataset" || name === "style") Object.assign(made[name], value);
    else if (name.includes("-") || name === "role" || name === "for") made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** A button that is off while what it does goes on; what fails is told. */
export function button(text, act, properties = {}) {
  const made = element("button", { type: "button", textContent: text, ...properties });
  made.addEventListener("click", async () => {
    made.disabled = true;
    try {
      await act(made);
    } catch (problem) {
      tell(problem);
    } finally {
      made.disabled = false;
    }
  });
  return made;
}

/** Of choices [word, text]. */
export function select(choices, value, properties) {
  const made = element("select", properties, ...choices.map(([word, text]) =>
    element("option", { value: word, textContent: text })));
  made.value = value;
  return made;
}

export const labelled = (text, control) => element("label", { className: "field" },
  element("span", { textContent: text }), control);

/** Shows what went wrong at the top of the page until the next thing goes well. */
export function tell(problem) {
  const place = document.getElementById("trouble");
  place.textContent = problem ? problem.message || String(problem) : "";
  place.hidden = !problem;
}
