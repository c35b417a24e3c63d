// SPDX-License-Identifier: MIT
// Elements of the page. Texts are only ever text: nothing is parsed as markup.

type Properties = Record<string, string | ((event: Event) => void)>;

export function el<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    properties: Properties = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (typeof value === "function") element.addEventListener(name, value);
        else element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
}

/** A table with a row of heads; a row may be a button. */
export function table(heads: string[], rows: { cells: (string | Node)[]; go?: () => void; id?: string }[]): HTMLElement {
    const body = rows.map(({ cells, go, id }) => {
        const row = el("tr", go ? { tabindex: "0", class: "link" } : {}, ...cells.map((cell) => el("td", {}, cell)));
        if (id) row.dataset.id = id;
        if (go) {
            row.addEventListener("click", go);
            row.addEventListener("keydown", (event) => event.key === "Enter" && go());
        }
        return row;
    });
    return el("table", {}, el("thead", {}, el("tr", {}, ...heads.map((head) => el("th", {}, head)))), el("tbody", {}, ...body));
}
