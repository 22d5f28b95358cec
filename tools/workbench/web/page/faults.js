// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes and warnings { key, text, line, file, warning } of a check.

/** Without "KEY = ", where the key stands beside it. */
export const withoutKey = ({ key, text }) => (key && text.startsWith(`${key} = `) ? text.slice(key.length + 3) : text);
