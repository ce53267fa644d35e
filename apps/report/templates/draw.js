'use strict';
const $ = (id) => document.getElementById(id), data = JSON.parse($('data').textContent);
const columns = 400, negligible = 1e-6; // columns of the frame, and misfits by rounding
let drawn = []; // heights, 0 to 1, at the drawn columns 0 to 400
let pen = null; // the pointer that draws: its id and its last place

const quantity = () => data.quantities[$('quantity').selectedIndex];
const is_load = () => quantity().name === 'load', is_contact = () => quantity().y === 'contact_fraction';
/** A column's name in words, such as "stiffness (MPa/mm)". */
const words = (column) => column.replace(/_([^_]+)_per_([^_]+)$/, ' ($1/$2)').replace(/_(MPa|mm)$/, ' ($1)')
    .replaceAll('_', ' ');
const brief = (value) => String(Number(value.toPrecision(4)));
const place = ({x, y}) => `${brief(y)} at ${brief(x)} ${quantity().x.split('_')[1]}`;

/** The fields as numbers, and what is wrong with them. Caps are tested if their number or radius is given. */
function fields() {
    const has_caps = quantity().name === 'area' && ($('number').value || $('radius').value);
    const inputs = [...document.querySelectorAll(quantity().name === 'area' ? 'input' : 'label:not(.caps)>input')];
    for (const input of document.querySelectorAll('.caps>input'))
        input.required = has_caps;
    return {...Object.fromEntries(inputs.map((one) => [one.id, one.valueAsNumber])), has_caps,
        problems: inputs.filter((one) => !one.validity.valid)
            .map((one) => `${one.parentElement.textContent.trim()}: ${one.validationMessage}`)};
}

/** Heights at all columns between knots [column, height], along straight lines. */
function joined(knots) {
    const all = [];
    knots.forEach(([column, height], i) => {
        const [from, first] = knots[i - 1] ?? [column, height];
        for (let c = from; c <= column; ++c)
            all[c] = column > from ? first + (height - first) * (c - from) / (column - from) : height;
    });
    return all;
}
const knots = () => drawn.map((height, column) => [column, height]).filter(([column]) => column > 0);

/** The points of the target, evenly spaced up to the last drawn column. */
function sampled({to, top, points, band}) {
    const known = knots(), result = [], rounded = (value) => Number(value.toPrecision(9));
    const heights = joined(known), [first, last] = [known[0]?.[0], known.at(-1)?.[0]];
    for (let k = 1; known.length && k <= points; ++k) {
        const at = last * k / points, c = Math.max(first, Math.floor(at));
        const y = rounded(top * (heights[c] + (at - c) * ((heights[c + 1] ?? heights[c]) - heights[c])));
        if (at >= first - 1e-9)
            result.push({x: rounded(to * at / columns), y, lower: rounded(y * (1 - band / 100)),
                upper: rounded(y * (1 + band / 100))});
    }
    return result;
}

/** Area of one cap under the whole load over the nominal area: pi (3 F R/(4 E*))^(2/3), by Hertz. */
const one_cap = ({radius, modulus, area}, pressure) =>
    Math.PI * (3 * pressure * area * radius / (4 * modulus)) ** (2 / 3) / area;

/** Curves that no response crosses: y at an x, whether it is the highest, and its name. */
function limits(last, values) {
    const M = data.full_contact, all = [];
    if (quantity().name === 'stiffness' && M) // the line of the last load steps reaches 2 M at most
        all.push({at: (x) => M * Math.max(1, 2 * x / last), highest: true, name: 'that of full contact'});
    if (values.has_caps)
        all.push({at: (x) => one_cap(values, x), highest: false, name: 'A_one, one cap with the whole load'},
            {at: (x) => Math.cbrt(values.number) * one_cap(values, x), highest: true, name: 'N^(1/3) A_one'});
    return all;
}

/** Why no surface meets the points (domain/target/out_of_reach.hpp): the worst violations, with the points at fault. */
function reasons(points, values) {
    const found = [], y_name = quantity().y, M = data.full_contact;
    const find = (search) => {
        let worst = {misfit: negligible};
        search((misfit, text, fault) => { if (misfit > worst.misfit) worst = {misfit, text: text(), fault}; });
        if (worst.text)
            found.push(worst);
    };
    if (data.nests && !is_load())
        find((consider) => points.forEach((p, i) => points.slice(i + 1).forEach((q) =>
            consider((p.lower - q.upper) / (p.y + q.y), () => `${y_name} falls from ${place(p)} to ${place(q)}: ` +
                'contact only grows under load, so it never falls', q))));
    if (data.nests && is_load())
        find((consider) => [{x: 0, y: 0, lower: 0, upper: 0}, ...points].forEach((a, i, all) =>
            all.slice(i + 1).forEach((b, j) => {
                if (M)
                    consider((b.lower - a.upper - M * (b.x - a.x)) / (b.y + a.y),
                        () => `the load rises to ${place(b)} faster than with full contact, ${brief(M)} MPa/mm`, b);
                for (const c of all.slice(i + j + 2)) {
                    const t = (b.x - a.x) / (c.x - a.x);
                    consider((b.lower - (1 - t) * a.upper - t * c.upper) / (b.y + (1 - t) * a.y + t * c.y),
                        () => `the load ${place(b)} is above the line from ${place(a)} to ${place(c)}: stiffness ` +
                            'never falls, so the load curve is convex', b);
                }
            })));
    for (const {at, highest, name} of limits(points.at(-1).x, values))
        find((consider) => points.forEach((p) => consider((highest ? p.lower - at(p.x) : at(p.x) - p.upper) / p.y,
            () => `${y_name} ${place(p)} is ${highest ? 'above' : 'below'} ${name}, ${brief(at(p.x))}`, p)));
    return found;
}

/** The file as rugosa reads it. */
function csv(points, band) {
    const {x, y} = quantity(), rows = points.map((p) => (band ? [p.x, p.y, p.lower, p.upper] : [p.x, p.y]).join());
    return [`${x},${y}${band ? ',lower,upper' : ''}`, ...rows, ''].join('\n');
}

function show() {
    const now = fields(), points = now.problems.length ? [] : sampled(now);
    const wrong = points.find((p) => !(p.y > 0) || (is_contact() && p.y > 1));
    const found = points.length && !wrong ? reasons(points, now) : [];
    const [state, badge, title, lines] =
        now.problems.length ? ['incomplete', 'undecidable', 'A field is out of range', now.problems] :
        !points.length ? ['incomplete', 'undecidable', 'Nothing is drawn', []] :
        wrong ? ['invalid', 'contradicted', 'Not a target', [`${quantity().y} is ${place(wrong)}; draw it above 0` +
            (is_contact() ? ' and at most at 1, full contact' : '')]] :
        found.length ? ['out-of-reach', 'contradicted', `Out of reach of every ${data.area ? 'map' : 'profile'}`,
            found.map(({text, misfit}) => `${text}; no similarity is above ${brief(1 - misfit)}`)] :
        ['open', 'reproduced', 'No reason against it', []];
    const ratios = now.has_caps ? points.map((p) => p.y / one_cap(now, p.x)) : [];
    if (ratios.length)
        lines.push(`A/A_one is ${brief(Math.min(...ratios))} to ${brief(Math.max(...ratios))} (A_one: the area of ` +
            `one cap with the whole load). N caps permit 1 to N^(1/3) = ${brief(Math.cbrt(now.number))}`);
    $('verdict').dataset.state = state;
    $('verdict').innerHTML = `<p><span class="badge ${badge}">${title}</span></p>` +
        lines.map((line) => `<p>${line}</p>`).join('');
    $('save').disabled = !points.length || wrong;
    $('csv').value = points.length ? csv(points, now.band) : '';
    paint(now, points, wrong ? [wrong] : found.map((one) => one.fault));
}

function paint(now, points, faults) {
    const [left, top, bottom] = [78, 14, 26], height = $('plot').clientHeight - top - bottom; // pixels
    const width = Math.max(0, $('plot').clientWidth - left - top);
    const shares = Array.from({length: 101}, (_, i) => i / 100);
    const at = ([x, y]) => [left + width * x, top + height * (1 - y)].map((one) => one.toFixed(1)).join(' ');
    const path = (id, lines) => `<path id="${id}" d="${lines.map((one) => 'M' + one.map(at).join('L')).join('')}"/>`;
    const dots = (all) => all.map((p) => [[p.x / now.to, p.y / now.top], [p.x / now.to, p.y / now.top]]);
    const lines = now.problems.length ? [] : limits(points.at(-1)?.x ?? now.to, now)
        .map((limit) => shares.map((x) => [x, limit.at(x * now.to) / now.top]).filter(([, y]) => y <= 1));
    const curve = knots().map(([column, share]) => [column / columns, share]);
    const label = (x, y, anchor, text) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${text}</text>`;
    $('plot').innerHTML = `<rect id="frame" x="${left}" y="${top}" width="${width}" height="${height}"/>` +
        path('limits', lines.filter((one) => one.length)) + path('curve', curve.length ? [curve] : []) +
        path('dots', dots(points)) + path('faults', dots(faults)) +
        (now.problems.length ? [] : [0, 0.5, 1]).map((share) =>
            label(left - 6, top + height * (1 - share) + 5, 'end', brief(share * now.top)) +
            label(left + width * share, top + height + 18, ['start', 'middle', 'end'][2 * share], brief(share * now.to))
        ).join('') + label(left + 8, top + 18, 'start', $('quantity').selectedOptions[0].text);
}

/** The column and height under the pointer. */
function place_of(event) {
    const box = $('frame').getBoundingClientRect(), share = (value) => Math.min(1, Math.max(0, value));
    return [Math.round(columns * share((event.clientX - box.left) / box.width)),
        1 - share((event.clientY - box.top) / box.height)];
}
function draw_to(event) {
    const to = place_of(event);
    joined([pen.at, to].sort((a, b) => a[0] - b[0])).forEach((height, column) => { drawn[column] = height; });
    drawn[to[0]] = to[1];
    pen.at = to;
    show();
}
$('plot').onpointerdown = (event) => {
    if (pen || event.button)
        return;
    $('plot').setPointerCapture(event.pointerId);
    pen = {id: event.pointerId, at: place_of(event)};
    draw_to(event);
};
$('plot').onpointermove = (event) => { if (event.pointerId === pen?.id) draw_to(event); };
$('plot').onpointerup = $('plot').onpointercancel = (event) => { if (event.pointerId === pen?.id) pen = null; };

/** Lifts falls, or lowers a load curve to the highest convex one below it. */
$('correct').onclick = () => {
    const hull = [[0, 0]];
    for (const [column, height] of knots()) {
        const is_corner = ([a, b], [c, d]) => (c - a) * (height - b) > (d - b) * (column - a);
        while (is_load() && hull.length > 1 && !is_corner(...hull.slice(-2)))
            hull.pop();
        hull.push([column, is_load() ? height : Math.max(height, hull.at(-1)[1])]);
    }
    drawn = joined(is_load() && hull.length > 1 ? hull : hull.slice(1));
    show();
};
$('clear').onclick = () => { drawn = []; show(); };
$('save').onclick = () => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([$('csv').value], {type: 'text/csv'}));
    link.download = data.file;
    link.click();
};
$('quantity').onchange = () => { // usual ranges
    const {name, x, y} = quantity(), steepest = data.full_contact || 2 * data.modulus / data.length_mm;
    const usual = x === 'pressure_MPa' ? 1.6e-4 * data.modulus : data.length_mm / 1000;
    const to = (name === data.quantity && data.to) || usual;
    $('to').value = brief(to);
    $('top').value = brief(is_contact() ? 1 : is_load() ? steepest * to : steepest);
    [$('x').textContent, $('y').textContent] = [words(x), words(y)];
    $('correct').textContent = is_load() ? 'Make it convex' : 'Remove falls';
    document.querySelectorAll('.caps').forEach((one) => { one.hidden = name !== 'area'; });
    show();
};
for (const {name, x, y} of data.quantities)
    $('quantity').append(new Option(`${words(y)} against ${words(x)}`, name, false, name === data.quantity));
for (const id of ['points', 'band', 'modulus', 'area'])
    $(id).value = data[id] ?? '';
$('save').textContent = `Save ${data.file}`;
$('model').textContent = `The limits hold for ${Object.entries(data.recorded)
    .map(([key, value]) => `${words(key)} ${isNaN(value) ? value : +value}`).join(', ')}. ` +
    'For another body, give its flags to rugosa target --draw. The file records no body.' +
    (data.nests ? '' : ' On these layers contact may shrink under load, so falls are permitted.');
document.querySelectorAll('input').forEach((one) => { one.oninput = show; });
onresize = show;
$('quantity').onchange();
