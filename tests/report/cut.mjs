// SPDX-License-Identifier: MIT
// What of a page lies outside its place. For page.evaluate(): it runs in the page, so it names nothing of this file.

/** Sentences of all that is beyond the window, is scrolled sideways, or is cut by what holds it. */
export function cut() {
    const wrong = new Set();
    const name = (e) => `<${e.tagName.toLowerCase()} class="${e.className}"> "${(e.textContent ?? "").trim().slice(0, 40)}"`;
    const span = (a, b) => `${a.toFixed(1)} to ${b.toFixed(1)}`;
    const hides = (value) => value !== "visible";
    if (document.documentElement.scrollWidth > innerWidth) wrong.add(`the page has ${document.documentElement.scrollWidth} px in ${innerWidth}`);
    for (const e of document.querySelectorAll("body *")) {
        const box = e.getBoundingClientRect();
        if (["SCRIPT", "OPTION"].includes(e.tagName) || !e.checkVisibility() || !box.width || !box.height) continue;
        if (box.right > innerWidth + 0.5 || box.left < -0.5) wrong.add(`outside: ${name(e)} ${span(box.left, box.right)}`);
        if (/auto|scroll/.test(getComputedStyle(e).overflowX) && e.scrollWidth > e.clientWidth + 1) wrong.add(`scrolls sideways: ${name(e)}`);
        if (e.matches(".row:not(.here) .text")) continue; // it is told in full where it is chosen
        for (const text of [...e.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE && node.data.trim())) {
            const range = document.createRange();
            range.selectNodeContents(text);
            for (const r of range.getClientRects()) {
                for (let holder = e; holder !== document.body; holder = holder.parentElement) {
                    const style = getComputedStyle(holder);
                    const b = holder.getBoundingClientRect();
                    if (hides(style.overflowX) && (r.right > b.right + 1 || r.left < b.left - 1)) wrong.add(`cut: ${name(e)} ${span(r.left, r.right)} in ${span(b.left, b.right)}`);
                    if (style.overflowY === "hidden" && (r.bottom > b.bottom + 2 || r.top < b.top - 2)) wrong.add(`cut in its height: ${name(e)}`);
                    if (/auto|scroll/.test(style.overflowY)) break; // it may be scrolled to
                }
            }
        }
    }
    // What stands over the picture and the strips covers nothing else there.
    const over = [...document.querySelectorAll(".tools > *, .labels > span, .legend, .caption, .strip-tools, .player > *, header > *")].filter((e) => e.checkVisibility() && e.textContent.trim());
    const boxes = over.map((e) => {
        const range = document.createRange();
        range.selectNodeContents(e);
        return range.getBoundingClientRect();
    });
    boxes.forEach((a, i) => boxes.slice(0, i).forEach((b, k) => {
        if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1) wrong.add(`${name(over[i])} covers ${name(over[k])}`);
    }));
    return [...wrong];
}
