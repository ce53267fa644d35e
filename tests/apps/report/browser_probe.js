// What a reader would see of the page in its frame, told to the page around it as JSON.
addEventListener('load', () => {
    const channels = (colour) => (colour.match(/[\d.]+/g) || [0, 0, 0, 0]).map(Number);
    const luminance = (colour) => {
        const linear = channels(colour).slice(0, 3).map((value) => {
            const share = value / 255;
            return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
    };
    const contrast = (a, b) => { // WCAG 2.1
        const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
        return (high + 0.05) / (low + 0.05);
    };
    const ground = (element) => {
        for (let at = element; at; at = at.parentElement) {
            const colour = getComputedStyle(at).backgroundColor;
            if (channels(colour)[3] !== 0)
                return colour;
        }
        return 'rgb(255,255,255)';
    };
    const box = (element) => element.getBoundingClientRect();
    const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;

    const pictures = [...document.querySelectorAll('.panels svg')].filter((svg) => box(svg).width > 0).map((svg) => {
        const frame = box(svg), texts = [...svg.querySelectorAll('text')];
        const boxes = texts.map(box);
        const lines = [...svg.querySelectorAll('path:not(.gridline),use')]
            .filter((line) => !line.closest('defs') && getComputedStyle(line).stroke !== 'none');
        const problems = [];
        boxes.forEach((one, i) => {
            if (one.left < frame.left - 1 || one.right > frame.right + 1 || one.top < frame.top - 1 ||
                one.bottom > frame.bottom + 1)
                problems.push('cut: ' + texts[i].textContent);
            for (let j = 0; j < i; ++j)
                if (overlap(one, boxes[j]))
                    problems.push('overlap: ' + texts[i].textContent + ' / ' + texts[j].textContent);
        });
        return {
            label: svg.getAttribute('aria-label'), width: frame.width, height: frame.height,
            inside: frame.left >= 0 && frame.right <= innerWidth, problems,
            letters: Math.min(...texts.map((text) =>
                parseFloat(getComputedStyle(text).fontSize) * frame.width / svg.viewBox.baseVal.width)),
            text: Math.min(...texts.map((text) => contrast(getComputedStyle(text).fill, ground(svg)))),
            lines: Math.min(...lines.map((line) => contrast(getComputedStyle(line).stroke, ground(svg)))),
        };
    });
    const words = [...document.querySelectorAll('h1,h2,p,figcaption,th,td,caption,a,dt,dd,code,.badge,.rule')]
        .filter((element) => box(element).width > 0)
        .map((element) => ({
            text: element.textContent.slice(0, 40),
            contrast: contrast(getComputedStyle(element).color, ground(element)),
        }));
    parent.postMessage(JSON.stringify({
        width: innerWidth, dark: matchMedia('(prefers-color-scheme:dark)').matches,
        scrolls: document.documentElement.scrollWidth > innerWidth, pictures,
        figures: document.querySelectorAll('figure').length,
        fetched: performance.getEntriesByType('resource').map((entry) => entry.name),
        faintest: words.reduce((least, word) => (word.contrast < least.contrast ? word : least)),
    }), '*');
});
