/* SPDX-License-Identifier: BSD-3-Clause */
/* The search field: entries of find.js that hold every word, whole words and short texts first. */
const field = document.getElementById("find"), list = document.getElementById("found");

function rank(text, words) {
    const parts = text.toLowerCase().split(/[^\w.-]+/);
    return words.reduce((sum, word) => sum + (parts.includes(word) ? 0 : 1), 0) + text.length / 1000;
}

field.addEventListener("input", () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    const hits = !words.length ? [] : FIND.filter(([text]) => words.every(word => text.toLowerCase().includes(word)));
    hits.sort((a, b) => rank(a[0], words) - rank(b[0], words));
    list.replaceChildren(...hits.slice(0, 15).map(([text, kind, place]) => {
        const entry = document.createElement("li"), link = document.createElement("a"), note = document.createElement("small");
        link.href = field.dataset.up + place;
        link.textContent = text;
        note.textContent = kind;
        entry.append(link, " ", note);
        return entry;
    }));
});
document.addEventListener("keydown", event => {
    if (event.key === "/" && document.activeElement !== field) {
        event.preventDefault();
        field.focus();
    } else if (event.key === "Enter" && document.activeElement === field && list.firstChild) {
        location.href = list.querySelector("a").href;
    }
});
