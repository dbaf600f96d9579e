-- A history as version 1 wrote it, with two runs. Never changed: databases like it exist.
CREATE TABLE runs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  identity TEXT NOT NULL UNIQUE,
  time TEXT NOT NULL, recorded TEXT NOT NULL,
  program TEXT NOT NULL, program_sha256 TEXT NOT NULL, log TEXT NOT NULL, log_sha256 TEXT NOT NULL,
  machine TEXT NOT NULL, tool TEXT NOT NULL, version TEXT NOT NULL,
  duration_s REAL, points INTEGER NOT NULL, passes INTEGER NOT NULL,
  judged INTEGER NOT NULL, not_judged_reasons TEXT NOT NULL, within_budget INTEGER NOT NULL, coverage_percent REAL,
  speed_p50_percent REAL, speed_p99_percent REAL,
  acceleration_p50_mm_s2 REAL, acceleration_p99_mm_s2 REAL, lag_p50_um REAL, lag_p99_um REAL,
  defects INTEGER NOT NULL, worst_severity INTEGER NOT NULL, worst_score REAL NOT NULL, deepest_um REAL NOT NULL,
  area_mm2 REAL NOT NULL, ra_um REAL, rz_um REAL);
CREATE INDEX runs_by_time ON runs (time, id);
CREATE TABLE parameters (
  run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE,
  name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (run, name)) WITHOUT ROWID;
CREATE TABLE defects (
  run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE, rank INTEGER NOT NULL,
  cause TEXT NOT NULL, quantity TEXT NOT NULL, severity INTEGER NOT NULL, score REAL NOT NULL,
  depth_um REAL NOT NULL, pit INTEGER NOT NULL, systematic INTEGER NOT NULL, speed_jump_percent REAL,
  length_mm REAL, area_mm2 REAL,
  tip_x REAL, tip_y REAL, tip_z REAL, x REAL, y REAL, z REAL, PRIMARY KEY (run, rank)) WITHOUT ROWID;
CREATE TABLE sections (
  run INTEGER NOT NULL, rank INTEGER NOT NULL, number INTEGER NOT NULL,
  pass INTEGER NOT NULL, first_line INTEGER NOT NULL, last_line INTEGER NOT NULL,
  PRIMARY KEY (run, rank, number),
  FOREIGN KEY (run, rank) REFERENCES defects ON DELETE CASCADE) WITHOUT ROWID;
CREATE INDEX sections_by_pass ON sections (pass, run, rank);
CREATE TABLE parameter_rules (
  name TEXT PRIMARY KEY, kind TEXT NOT NULL, unit TEXT NOT NULL, low REAL, high REAL, required INTEGER NOT NULL);
CREATE TABLE parameter_values (
  name TEXT NOT NULL REFERENCES parameter_rules ON DELETE CASCADE, number INTEGER NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY (name, number)) WITHOUT ROWID;
INSERT INTO runs VALUES (1,'a','2026-11-20T06:00:00Z','2026-11-20T06:10:00Z','part.nc','p1','monday.biip','l1','mill 3','ball:6','0.1.0',27.5,25000,118,1,'',1,91.5,0.4,12.25,30.0,410.5,NULL,NULL,1,2,3.5,7.75,1.5,0.31,1.62);
INSERT INTO runs VALUES (2,'b','2026-11-21T06:00:00Z','2026-11-21T06:10:00Z','part.nc','p1','tuesday.biip','l2','','','0.1.0',27.5,25000,118,0,'Too little was compared.',0,12.0,NULL,NULL,NULL,NULL,NULL,NULL,0,0,0.0,0.0,0.0,NULL,NULL);
INSERT INTO parameters VALUES (1,'tool','D6R3');
INSERT INTO defects VALUES (1,1,'feed_drop','speed',2,3.5,7.75,1,0,-82.0,4.5,1.5,1.0,2.0,3.0,1.5,2.5,3.5);
INSERT INTO sections VALUES (1,1,0,7,500,512);
INSERT INTO parameter_rules VALUES ('tool','text','',NULL,NULL,1);
INSERT INTO parameter_values VALUES ('tool',0,'D6R3');
PRAGMA application_id = 1668051816;
PRAGMA user_version = 1;
