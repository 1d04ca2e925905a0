// browse.js PAGE SCREENSHOT: headless Chromium opens a report; exit 1 when it has an error, its canvas is blank, or a click
// on a node does not show what that sees; 77 when puppeteer or Chromium is not installed (tools/setup --long).
const fs = require('fs');
const path = require('path');

let puppeteer;
try {
    puppeteer = require('puppeteer-core');
} catch {
    console.log('puppeteer-core is not installed (tools/setup --test)');
    process.exit(77);
}
const chromium = ['/usr/bin/chromium', '/usr/bin/google-chrome'].find((file) => fs.existsSync(file));
if (!chromium) {
    console.log('chromium is not installed (tools/setup --long)');
    process.exit(77);
}

const [page_file, screenshot] = process.argv.slice(2);
const problems = [];
const expect = (holds, problem) => { if (!holds) problems.push(problem); };

// How many colours a picture of an element has, and how many pixels are not its first one's.
async function variety(page, selector) {
    const element = await page.$(selector);
    return page.evaluate((canvas) => {
        const copy = document.createElement('canvas');
        copy.width = canvas.width;
        copy.height = canvas.height;
        const context = copy.getContext('2d');
        context.drawImage(canvas, 0, 0);
        const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
        const counts = new Map();
        for (const word of words) counts.set(word, (counts.get(word) || 0) + 1);
        return { colors: counts.size, drawn: words.length - (counts.get(words[0]) || 0), pixels: words.length };
    }, element);
}

(async () => {
    const browser = await puppeteer.launch({
        executablePath: chromium,
        args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    });
    const page = await browser.newPage();
    await page.setViewport({ width: 1400, height: 1000 });
    page.on('pageerror', (error) => problems.push(`error: ${error.message}`));
    page.on('console', (message) => { if (message.type() === 'error') problems.push(`console: ${message.text()}`); });
    page.on('request', (request) => {
        expect(/^(file|data|blob):/.test(request.url()), `it asks the network for ${request.url().slice(0, 80)}`);
    });
    await page.goto(`file://${path.resolve(page_file)}`);
    await page.waitForSelector('body[data-ready=yes]', { timeout: 60000 });
    expect(await page.$eval('#no-view', (element) => element.hidden), 'there is no 3D view');

    const view = await variety(page, '#canvas');
    console.log(`canvas: ${view.colors} colours, ${view.drawn} of ${view.pixels} pixels drawn`);
    expect(view.colors > 20 && view.drawn > 0.01 * view.pixels, 'the canvas is blank');

    const count = await page.evaluate(() => JSON.parse(document.getElementById('skeleton').textContent).nodes.length);
    const rows = await page.$$eval('#branches tbody tr', (list) => list.length);
    const wanted = await page.evaluate(() => JSON.parse(document.getElementById('skeleton').textContent).branches.length);
    expect(rows === wanted, `${rows} rows for ${wanted} branches`);

    // The node that is nearest to the eye, where nothing is in front of it.
    const node = await page.evaluate((n) => {
        let best = 0;
        for (let i = 1; i < n; ++i) if (window.zskel.seen(i).depth < window.zskel.seen(best).depth) best = i;
        return best;
    }, count);
    const at = await page.evaluate((n) => window.zskel.seen(n), node);
    await page.mouse.click(at.x, at.y);
    await page.waitForSelector(`#map[data-node="${node}"] canvas`, { timeout: 10000 }).catch(() => {
        problems.push(`a click on node ${node} shows no map`);
    });
    const text = await page.$eval('#node', (element) => element.textContent);
    expect(text.startsWith(`Node ${node} at`), `a click on node ${node} says: ${text}`);
    if ((await page.$$('#map canvas')).length === 6) {
        const map = await variety(page, '#map canvas');
        console.log(`map of node ${node}: ${map.colors} shades`);
        expect(map.colors > 1, 'the map is blank');
    } else {
        problems.push('the map has not six faces');
    }

    if (wanted > 0) {
        await page.click('#branches tbody tr');
        const chosen = await page.$$eval('#branches tr.chosen', (list) => list.length);
        expect(chosen === 1, `${chosen} rows are chosen after a click on one`);
        expect(await page.$('#radius-plot svg path.curve'), 'no radius is plotted');
    }
    // A drag turns the model, and chooses nothing.
    await page.evaluate(() => window.scrollTo(0, 0));
    const before = await page.$eval('#canvas', (canvas) => canvas.toDataURL());
    const box = await (await page.$('#canvas')).boundingBox();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.6 * box.height, { steps: 5 });
    await page.mouse.up();
    expect(before !== await page.$eval('#canvas', (canvas) => canvas.toDataURL()), 'a drag does not turn the model');
    expect(await page.evaluate(() => window.zskel.state.node) === node, 'a drag chooses another node');

    await page.screenshot({ path: screenshot });
    await browser.close();
    for (const problem of problems) console.log(problem);
    process.exit(problems.length > 0 ? 1 : 0);
})();
