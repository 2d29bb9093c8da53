# Nothing is aimed at mirrors and glass.
/^static bool is_specular(/,/^}/d
/kind == PM_MAP_CAUSTIC ? is_specular/{N;s/kind == .*: *//;}
s/(kind == PM_MAP_CAUSTIC || !spread)/!spread/
s/kind != PM_MAP_CAUSTIC && //
