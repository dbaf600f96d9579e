// Writes the reports that several test files look at, and what `check` says of the same run.

import { bottle, run, writeReport } from './browser.mjs';

writeReport('bottle.html', bottle);
writeReport('ball.html', bottle, '--tool', 'ball:6');
run('check', bottle.program, bottle.log, '-o', 'bottle.json', '-q');
